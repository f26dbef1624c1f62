// All that waits to be said to the host in control.
#pragma once

#include "server/world/events.h"
#include "server/world/ig_messages.h"
#include "server/world/requests.h"
#include "server/world/responder.h"

namespace skyig::server::world {

struct Outbox {
    Requests requests;
    /// Those of a request that was looked into and found no room yet.
    Responses responses;
    Events events;
    IgMessages messages;

    /// Another host, or Standby: nobody waits for these any more.
    void clear() noexcept {
        requests.clear();
        responses.clear();
        events.clear();
    }
};

}  // namespace skyig::server::world
