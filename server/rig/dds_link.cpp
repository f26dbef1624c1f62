#include "server/rig/dds_link.h"

#include <dds/dds.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "server/rig/rig_types.h"

namespace skyig::server::rig {

namespace {

using DdsFrame = skyig_rig_v1_FrameState;
using DdsShow = skyig_rig_v1_FrameShow;
using DdsNode = skyig_rig_v1_NodeState;

/// A speaker that has not said a word for so long is gone, for the carrier; the rig's own watch is closer.
constexpr dds_duration_t kLease = DDS_SECS(1);
/// A machine that is found again after a cut cable: asked for as often.
constexpr std::string_view kAskEvery = "500ms";
/// The frame loop gives a full send queue no more than that.
constexpr dds_duration_t kMostBlocking = DDS_MSECS(2);

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&' || c == '<' || c == '>' || c == '"' || c == '\'')
            fmt::format_to(std::back_inserter(out), "&#{};", static_cast<int>(c));
        else
            out += c;
    }
    return out;
}

bool is_address(const std::string& interface) {
    return !interface.empty() && interface.find_first_not_of("0123456789.") == std::string::npos;
}

/// An entity and all that was made of it.
class Entity {
  public:
    explicit Entity(dds_entity_t made) noexcept : entity_(made) {}
    ~Entity() {
        if (entity_ > 0) dds_delete(entity_);
    }
    Entity(Entity&& other) noexcept : entity_(std::exchange(other.entity_, 0)) {}
    Entity& operator=(Entity&& other) noexcept {
        std::swap(entity_, other.entity_);
        return *this;
    }
    Entity(const Entity&) = delete;
    Entity& operator=(const Entity&) = delete;

    [[nodiscard]] dds_entity_t get() const noexcept { return entity_; }
    [[nodiscard]] bool made() const noexcept { return entity_ > 0; }

  private:
    dds_entity_t entity_;
};

/// What is longer than its place is cut: names are checked by the settings.
template <std::size_t kSize>
void put(char (&place)[kSize], const std::string& text) noexcept {
    const std::size_t length = std::min(text.size(), kSize - 1);
    std::memcpy(place, text.data(), length);
    place[length] = '\0';
}

void put(DdsFrame& to, const FrameMessage& message) noexcept {
    put(to.node, message.from.node);
    to.session = message.from.session;
    put(to.build, message.from.build);
    to.settings = message.from.settings;
    to.rank = message.rank;
    to.frame = message.frame;
    to.state._length = static_cast<std::uint32_t>(message.state.size());
    std::memcpy(to.state._buffer, message.state.data(), message.state.size());
    to.tag = message.tag;
}

void get(const DdsFrame& from, FrameMessage& message) {
    message.from.node = from.node;
    message.from.session = from.session;
    message.from.build = from.build;
    message.from.settings = from.settings;
    message.rank = from.rank;
    message.frame = from.frame;
    const auto* bytes = reinterpret_cast<const std::byte*>(from.state._buffer);
    message.state.assign(bytes, bytes + from.state._length);
    message.tag = from.tag;
}

void put(DdsShow& to, const ShowMessage& message) noexcept {
    put(to.node, message.node);
    to.session = message.session;
    to.frame = message.frame;
    to.tag = message.tag;
}

void get(const DdsShow& from, ShowMessage& message) {
    message.node = from.node;
    message.session = from.session;
    message.frame = from.frame;
    message.tag = from.tag;
}

void put(DdsNode& to, const NodeMessage& message) noexcept {
    put(to.node, message.from.node);
    to.session = message.from.session;
    put(to.build, message.from.build);
    to.settings = message.from.settings;
    to.state = static_cast<std::uint8_t>(message.state);
    put(to.leader, message.leader);
    to.leader_session = message.leader_session;
    to.drawn_frame = message.drawn_frame;
    to.drawing_ns = message.drawing_ns;
    to.repeats = message.repeats;
    to.late = message.late;
    put(to.gl, message.gl);
    to.gl_errors = message.gl_errors;
    to.tag = message.tag;
}

void get(const DdsNode& from, NodeMessage& message) {
    message.from.node = from.node;
    message.from.session = from.session;
    message.from.build = from.build;
    message.from.settings = from.settings;
    message.state = static_cast<NodeState>(from.state);
    message.leader = from.leader;
    message.leader_session = from.leader_session;
    message.drawn_frame = from.drawn_frame;
    message.drawing_ns = from.drawing_ns;
    message.repeats = from.repeats;
    message.late = from.late;
    message.gl = from.gl;
    message.gl_errors = from.gl_errors;
    message.tag = from.tag;
}

/// A sample that is written and one that is taken, made once.
template <class Sample>
class Samples {
  public:
    explicit Samples(const dds_topic_descriptor_t& type) noexcept : type_(type) {
        if constexpr (std::is_same_v<Sample, DdsFrame>) {
            for (Sample* sample : {&out, &in}) {
                sample->state._buffer = static_cast<std::uint8_t*>(dds_alloc(kMostStateBytes));
                sample->state._maximum = kMostStateBytes;
                sample->state._release = true;
            }
        }
    }
    ~Samples() {
        dds_sample_free(&out, &type_, DDS_FREE_CONTENTS);
        dds_sample_free(&in, &type_, DDS_FREE_CONTENTS);
    }
    Samples(const Samples&) = delete;
    Samples& operator=(const Samples&) = delete;

    Sample out{};
    Sample in{};

  private:
    const dds_topic_descriptor_t& type_;
};

struct Wants {
    int kept = 1;
    bool for_late = false;
    dds_duration_t deadline = DDS_INFINITY;
    bool writes = true;
    bool reads = true;
};

/// One topic, to all and from all others.
template <class Sample>
class Channel {
  public:
    Channel(dds_entity_t participant, const char* name, const dds_topic_descriptor_t& type,
            const Wants& wants)
        : samples_(type),
          wants_(wants),
          topic_(dds_create_topic(participant, &type, name, nullptr, nullptr)) {
        dds_qos_t* qos = dds_create_qos();
        dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, kMostBlocking);
        dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, wants.kept);
        dds_qset_durability(qos, wants.for_late ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
        dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, wants.kept, DDS_LENGTH_UNLIMITED,
                                    DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
        dds_qset_deadline(qos, wants.deadline);
        dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, kLease);
        dds_qset_ownership(qos, DDS_OWNERSHIP_SHARED);
        dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
        if (wants.writes) writer_ = Entity(dds_create_writer(participant, topic_.get(), qos, nullptr));
        if (wants.reads) reader_ = Entity(dds_create_reader(participant, topic_.get(), qos, nullptr));
        dds_delete_qos(qos);
        if (reader_.made()) ready_ = Entity(dds_create_readcondition(reader_.get(), DDS_ANY_STATE));
    }

    [[nodiscard]] bool made() const noexcept {
        return topic_.made() && writer_.made() == wants_.writes && reader_.made() == wants_.reads &&
               ready_.made() == wants_.reads;
    }
    [[nodiscard]] dds_entity_t ready() const noexcept { return ready_.get(); }

    template <class Message>
    [[nodiscard]] bool write(const Message& message) noexcept {
        put(samples_.out, message);
        return dds_write(writer_.get(), &samples_.out) == DDS_RETCODE_OK;
    }

    template <class Message>
    [[nodiscard]] bool take(Message& message) {
        while (wants_.reads) {
            void* place = &samples_.in;
            dds_sample_info_t info;
            if (dds_take(reader_.get(), &place, &info, 1, 1) != 1) return false;
            // Else it tells that a speaker came or went.
            if (!info.valid_data) continue;
            get(samples_.in, message);
            return true;
        }
        return false;
    }

    void count(LinkCounts& counts) const noexcept {
        dds_requested_deadline_missed_status_t deadlines{};
        if (dds_get_requested_deadline_missed_status(reader_.get(), &deadlines) == DDS_RETCODE_OK)
            counts.deadlines_missed += deadlines.total_count;
        dds_liveliness_changed_status_t liveliness{};
        if (dds_get_liveliness_changed_status(reader_.get(), &liveliness) == DDS_RETCODE_OK)
            counts.speakers_lost += liveliness.not_alive_count;
        dds_sample_lost_status_t lost{};
        if (dds_get_sample_lost_status(reader_.get(), &lost) == DDS_RETCODE_OK)
            counts.overwritten += lost.total_count;
    }

  private:
    Samples<Sample> samples_;
    Wants wants_;
    Entity topic_;
    Entity writer_{0};
    Entity reader_{0};
    Entity ready_{0};
};

class DdsLink final : public Link {
  public:
    DdsLink(Entity domain, Entity participant, const DdsSettings& settings)
        : domain_(std::move(domain)),
          participant_(std::move(participant)),
          frames_(participant_.get(), "skyig_frame_state_1", skyig_rig_v1_FrameState_desc,
                  {.kept = DdsSettings::kKeptStates,
                   .for_late = true,
                   .deadline = 2 * settings.period_ns,
                   .writes = settings.may_lead}),
          shows_(participant_.get(), "skyig_frame_show_1", skyig_rig_v1_FrameShow_desc,
                 {.writes = settings.may_lead}),
          nodes_(participant_.get(), "skyig_node_state_1", skyig_rig_v1_NodeState_desc,
                 {.for_late = true, .reads = settings.may_lead}),
          waits_(dds_create_waitset(participant_.get())) {
        for (const dds_entity_t ready : {frames_.ready(), shows_.ready(), nodes_.ready()}) {
            if (ready <= 0) continue;
            unattached_ += waits_.made() && dds_waitset_attach(waits_.get(), ready, 0) == 0 ? 0 : 1;
        }
    }

    [[nodiscard]] bool made() const noexcept {
        return frames_.made() && shows_.made() && nodes_.made() && unattached_ == 0;
    }

    void send(const FrameMessage& message) override {
        tell(message.state.size() <= kMostStateBytes && frames_.write(message));
    }
    void send(const ShowMessage& message) override { tell(shows_.write(message)); }
    void send(const NodeMessage& message) override { tell(nodes_.write(message)); }
    bool take(FrameMessage& message) override { return frames_.take(message); }
    bool take(ShowMessage& message) override { return shows_.take(message); }
    bool take(NodeMessage& message) override { return nodes_.take(message); }

    void wait(std::int64_t most_ns) override {
        (void)dds_waitset_wait(waits_.get(), nullptr, 0, std::max<std::int64_t>(most_ns, 0));
    }

    [[nodiscard]] LinkCounts counts() const override {
        LinkCounts counts = counts_;
        frames_.count(counts);
        return counts;
    }

  private:
    void tell(bool sent) noexcept { ++(sent ? counts_.sent : counts_.send_failures); }

    Entity domain_;
    Entity participant_;
    Channel<DdsFrame> frames_;
    Channel<DdsShow> shows_;
    Channel<DdsNode> nodes_;
    Entity waits_;
    int unattached_ = 0;
    LinkCounts counts_;
};

}  // namespace

std::string cyclone_settings(const DdsSettings& settings) {
    std::string peers;
    for (const std::string& peer : settings.peers)
        fmt::format_to(std::back_inserter(peers), "<Peer address=\"{}\"/>", escaped(peer));
    return fmt::format(
        "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface {}=\"{}\" "
        "multicast=\"false\"/>"
        "</Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
        "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
        "<SPDPInterval>{}</SPDPInterval><Peers>{}</Peers></Discovery></Domain></CycloneDDS>",
        is_address(settings.interface) ? "address" : "name", escaped(settings.interface),
        settings.most_programs, kAskEvery, peers);
}

protocol::Result<std::unique_ptr<Link>, std::string> open_dds_link(const DdsSettings& settings) {
    Entity domain(dds_create_domain(settings.domain, cyclone_settings(settings).c_str()));
    if (!domain.made())
        return protocol::Error{fmt::format("DDS does not start: {}", dds_strretcode(domain.get()))};
    Entity participant(dds_create_participant(settings.domain, nullptr, nullptr));
    if (!participant.made()) {
        return protocol::Error{fmt::format("DDS has no access to the network by interface {}: {}",
                                           settings.interface, dds_strretcode(participant.get()))};
    }
    auto link = std::make_unique<DdsLink>(std::move(domain), std::move(participant), settings);
    if (!link->made()) return protocol::Error{std::string("DDS makes no topics: out of resources")};
    return std::unique_ptr<Link>(std::move(link));
}

}  // namespace skyig::server::rig
