#include "protocol/canaerospace/reason.h"

#include <array>

namespace skyig::protocol::canaerospace {
namespace {

struct Words {
    Outcome outcome;
    std::string_view name;
    std::string_view text;
};

constexpr std::array<Words, kReasons> kWords{{
    {Outcome::kAccept, "none", "no fault"},
    {Outcome::kReject, "identifier",
     "29-bit identifier whose low 16 bits are above 2031: no CANaerospace parameter"},
    {Outcome::kReject, "remote", "remote frame: CANaerospace has data frames only"},
    {Outcome::kReject, "short", "fewer than the four bytes of a CANaerospace header"},
    {Outcome::kReject, "reserved_type", "data type 32..99 is reserved"},
    {Outcome::kReject, "user_type", "data type 100..255 that the identifier map does not name"},
    {Outcome::kReject, "length", "length is not 4 plus the size of the data type"},
    {Outcome::kReject, "type", "this identifier does not take this data type"},
    {Outcome::kReject, "ascii", "ASCII text holds a byte above 127"},
    {Outcome::kReject, "nonfinite", "the value is a NaN or an infinity"},
    {Outcome::kReject, "scale", "the scale of a SHORT2 must be above 0"},
    {Outcome::kReject, "layer", "cloud layers are numbered 0 to 7"},
    {Outcome::kReject, "range", "the value is out of the parameter's range"},
    {Outcome::kReject, "calendar", "no time of the day, or no day of the calendar"},
    {Outcome::kReject, "lone_low", "DOUBLEL without a DOUBLEH before it"},
    {Outcome::kReject, "pair", "DOUBLEL that does not continue the DOUBLEH before it"},
    {Outcome::kReject, "late_low", "DOUBLEL too long after its DOUBLEH"},
    {Outcome::kIgnore, "fd", "CAN FD frame: CANaerospace is classic CAN"},
    {Outcome::kIgnore, "unassigned", "identifiers 2032 to 2047 have no meaning"},
    {Outcome::kIgnore, "user_range", "user-defined or debug identifier that the map does not name"},
    {Outcome::kIgnore, "unknown", "identifier that the map does not name"},
    {Outcome::kIgnore, "service", "node service that is reserved or user-defined"},
    {Outcome::kDuplicate, "duplicate", "message code as in the frame before"},
    {Outcome::kStale, "older", "message code older than one already received"},
    {Outcome::kBusError, "bus_off", "the controller is off the bus"},
    {Outcome::kBusError, "no_acknowledge", "nobody acknowledged a transmission"},
    {Outcome::kBusError, "controller", "the controller lost frames or counts errors"},
    {Outcome::kBusError, "protocol", "protocol violation on the bus"},
    {Outcome::kBusError, "transceiver", "fault of the transceiver"},
    {Outcome::kBusError, "transmit_timeout", "a transmission timed out"},
    {Outcome::kBusError, "lost_arbitration", "arbitration was lost"},
    {Outcome::kBusError, "restarted", "the controller was restarted"},
    {Outcome::kBusError, "bus_error", "error on the bus"},
}};

const Words& words(Reason reason) noexcept {
    const auto index = static_cast<std::size_t>(reason);
    return kWords[index < kReasons ? index : 0];
}

}  // namespace

std::string_view outcome_name(Outcome outcome) noexcept {
    switch (outcome) {
        case Outcome::kAccept:
            return "accept";
        case Outcome::kReject:
            return "reject";
        case Outcome::kIgnore:
            return "ignore";
        case Outcome::kDuplicate:
            return "duplicate";
        case Outcome::kStale:
            return "stale";
        case Outcome::kBusError:
            break;
    }
    return "bus-error";
}

std::string_view reason_name(Reason reason) noexcept {
    return words(reason).name;
}

std::string_view reason_text(Reason reason) noexcept {
    return words(reason).text;
}

Outcome outcome_of(Reason reason) noexcept {
    return words(reason).outcome;
}

Reason bus_error_reason(std::uint32_t classes) noexcept {
    struct Class {
        std::uint32_t bit;
        Reason reason;
    };
    static constexpr std::array<Class, 8> kClasses{{{0x040, Reason::kBusOff},
                                                    {0x020, Reason::kNoAcknowledge},
                                                    {0x004, Reason::kController},
                                                    {0x008, Reason::kProtocol},
                                                    {0x010, Reason::kTransceiver},
                                                    {0x001, Reason::kTransmitTimeout},
                                                    {0x002, Reason::kLostArbitration},
                                                    {0x100, Reason::kRestarted}}};
    for (const Class& each : kClasses) {
        if ((classes & each.bit) != 0) return each.reason;
    }
    return Reason::kBusError;
}

}  // namespace skyig::protocol::canaerospace
