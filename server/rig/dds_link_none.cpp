// In the place of dds_link.cpp where Cyclone DDS was not there when this was built.
#include "server/rig/dds_link.h"

namespace skyig::server::rig {

std::string cyclone_settings(const DdsSettings& /*settings*/) {
    return {};
}

protocol::Result<std::unique_ptr<Link>, std::string> open_dds_link(const DdsSettings& /*settings*/) {
    return protocol::Error{
        std::string("this skyigd was built without Cyclone DDS (Debian: cyclonedds-dev, cyclonedds-tools): "
                    "a rig of several machines is left out, one machine draws all channels without --node")};
}

}  // namespace skyig::server::rig
