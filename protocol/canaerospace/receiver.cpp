#include "protocol/canaerospace/receiver.h"

namespace skyig::protocol::canaerospace {
namespace {

constexpr std::array<std::string_view, kEvents> kEventNames{
    "frames",     "accepted",      "published", "lost",     "restarted", "unchecked",
    "unfinished", "other_channel", "fell_over", "returned", "commits",   "layers_held"};

constexpr double kOktas = 8.0;
constexpr double kMilliseconds = 1e-3;

std::uint64_t bits_in(std::uint8_t mask) noexcept {
    std::uint64_t bits = 0;
    for (unsigned rest = mask; rest != 0; rest &= rest - 1)
        ++bits;
    return bits;
}

/// The update's number: coverage comes as oktas or as a fraction.
double normalised(const Message& message, const Value& value) noexcept {
    const bool oktas = message.entry->meaning == Meaning::kCoverage && value.kind == Value::Kind::kInteger;
    return oktas ? value.number / kOktas : value.number;
}

}  // namespace

std::string_view event_name(Event event) noexcept {
    const auto index = static_cast<std::size_t>(event);
    return index < kEvents ? kEventNames[index] : std::string_view("none");
}

std::uint64_t Counters::operator[](Outcome outcome) const noexcept {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kReasons; ++i) {
        if (outcome_of(static_cast<Reason>(i)) == outcome) sum += reasons[i];
    }
    return sum;
}

Receiver::Receiver(const IdentifierMap& map, const ReceiverOptions& options)
    : index_(map), options_(options) {}

Reception Receiver::receive(const CanFrame& frame) noexcept {
    Reception reception;
    Reading& reading = reception.reading;
    reading = read_frame(frame, index_);
    // Services and emergency events are told, but have no codes to count and no parameter to set.
    const bool is_parameter = reading.message.entry != nullptr;
    if (reading.reason == Reason::kNone && is_parameter) judge(frame, reading);
    ++counters_[Event::kFrames];
    ++counters_.reasons[static_cast<std::size_t>(reading.reason)];
    if (reading.reason != Reason::kNone) {
        reading.value = {};
        return reception;
    }
    ++counters_[Event::kAccepted];
    if (is_parameter && !reading.message.is(DataType::kDoubleH)) publish(frame, reception);
    return reception;
}

void Receiver::judge(const CanFrame& frame, Reading& reading) noexcept {
    const Message& message = reading.message;
    Stream& stream = streams_.find(StreamKey::of(message.id, message.channel, message.node));
    const std::int64_t timeout_ns = times_of(*message.entry).restart_after_ns();
    const HighHalf high = stream.high;
    const bool is_low = message.is(DataType::kDoubleL);
    const bool completes = is_low && high.waiting && high.message_code == message.message_code;
    // Tried on a copy: a low half may yet be refused, and then its code is not remembered.
    Stream after = stream;
    const CodeVerdict verdict =
        judge_code(after, message.message_code, completes, frame.received_ns, timeout_ns);
    reading.reason = verdict.reason;
    if (reading.reason == Reason::kNone && is_low) {
        reading.reason = join(stream, frame, reading);
        after.high = stream.high;
        if (reading.reason != Reason::kNone) {
            stream.seen_ns = frame.received_ns;
            return;
        }
    }
    stream = after;
    count(verdict);
    if (reading.reason != Reason::kNone || !message.is(DataType::kDoubleH)) return;
    if (high.waiting) ++counters_[Event::kUnfinished];
    stream.high = {true, message.message_code, message.service_code, reading.word, frame.received_ns};
}

void Receiver::count(const CodeVerdict& verdict) noexcept {
    counters_[Event::kLost] += verdict.lost;
    if (verdict.restarted) ++counters_[Event::kRestarted];
    if (verdict.became_unchecked) ++counters_[Event::kUnchecked];
}

/// Completes the double whose high half waits in `stream`, which then waits no more.
Reason Receiver::join(Stream& stream, const CanFrame& frame, Reading& reading) noexcept {
    const HighHalf high = stream.high;
    stream.high = {};
    if (!high.waiting) return Reason::kLoneLow;
    const auto fault = [this](Reason reason) {
        ++counters_[Event::kUnfinished];
        return reason;
    };
    const Message& message = reading.message;
    const auto step = static_cast<std::uint8_t>(message.message_code - high.message_code);
    if (step > 1 || message.service_code != high.service_code) return fault(Reason::kPair);
    if (elapsed_ns(high.received_ns, frame.received_ns) > options_.pair_within_ns)
        return fault(Reason::kLateLow);
    return read_double(*message.entry, high.word, reading.word, reading.value);
}

bool Receiver::choose_channel(const Message& message, std::int64_t received_ns) noexcept {
    ChannelChoice& choice = channels_[index_of(message.entry->parameter)];
    switch (choice.hear(message.channel, received_ns, times_of(*message.entry).silent_after_ns(),
                        options_.channel_returns_after_ns)) {
        case ChannelStep::kIdle:
            ++counters_[Event::kOtherChannel];
            return false;
        case ChannelStep::kFellOver:
            ++counters_[Event::kFellOver];
            break;
        case ChannelStep::kReturned:
            ++counters_[Event::kReturned];
            break;
        case ChannelStep::kUsed:
        case ChannelStep::kFirst:
            break;
    }
    return true;
}

void Receiver::publish(const CanFrame& frame, Reception& reception) noexcept {
    const Message& message = reception.reading.message;
    const Value& value = reception.reading.value;
    if (!choose_channel(message, frame.received_ns)) return;
    Update& update = reception.update;
    update.parameter = message.entry->parameter;
    update.layer = message.entry->layered ? message.service_code : std::uint8_t{0};
    update.node = message.node;
    update.channel = message.channel;
    update.value = normalised(message, value);
    update.items = value.items;
    update.received_ns = frame.received_ns;
    if (update.parameter == Parameter::kCommit) {
        commit(message, value.kind != Value::Kind::kNone, update);
    } else {
        take_in(message, update);
    }
    reception.published = true;
    ++counters_[Event::kPublished];
}

void Receiver::take_in(const Message& message, Update& update) noexcept {
    const std::int64_t at_ns = update.received_ns;
    switch (update.parameter) {
        case Parameter::kUtc:
            clock_.set_time_of_day(update.value, index_.map().conventions.hundredths ? 0.01 : 1.0, at_ns);
            return;
        case Parameter::kDate:
            clock_.set_date(static_cast<std::int64_t>(update.value), at_ns);
            return;
        case Parameter::kUtcMilliseconds:
            clock_.set_time_of_day(update.value * kMilliseconds, kMilliseconds, at_ns);
            return;
        case Parameter::kJulianDate:
            clock_.set_julian_date(update.value, at_ns);
            return;
        case Parameter::kTimeRate:
            clock_.set_rate(update.value, at_ns);
            return;
        default:
            break;
    }
    weather_.stage(update.parameter, update.layer, update.value);
    const bool is_weather = is_surface_weather(update.parameter) || is_layer_weather(update.parameter);
    if (is_weather && options_.weather == WeatherMode::kAtOnce)
        commit(message, is_layer_weather(update.parameter), update);
}

/// \param one_layer  commit layer `update.layer` (of the parameter) or `update.value` (of the commit) alone
void Receiver::commit(const Message& message, bool one_layer, Update& update) noexcept {
    if (one_layer && !message.entry->layered) update.layer = static_cast<std::uint8_t>(update.value);
    update.held_layers = one_layer ? weather_.commit_layer(update.layer) : weather_.commit_all();
    ++counters_[Event::kCommits];
    counters_[Event::kLayersHeld] += bits_in(update.held_layers);
}

bool Receiver::is_stale(Parameter parameter, std::int64_t now_ns) const noexcept {
    const ChannelChoice& choice = channels_[index_of(parameter)];
    if (!choice.heard()) return true;
    const std::int64_t limit_ns = times_of(index_.map()[parameter]).stale_after_ns;
    return limit_ns != kNever && elapsed_ns(choice.last_ns(), now_ns) > limit_ns;
}

std::optional<std::uint16_t> Receiver::channel_of(Parameter parameter) const noexcept {
    const ChannelChoice& choice = channels_[index_of(parameter)];
    if (!choice.heard()) return std::nullopt;
    return choice.channel();
}

}  // namespace skyig::protocol::canaerospace
