#include "protocol/metar/values.h"

#include "protocol/metar/codes.h"

namespace skyig::protocol::metar {
namespace {

template <class E, std::size_t count>
std::string_view name_in(const std::array<std::string_view, count>& names, E value) noexcept {
    const auto index = static_cast<std::size_t>(value);
    return index < count ? names[index] : std::string_view();
}

}  // namespace

std::string_view name(Intensity intensity) noexcept {
    constexpr std::array<std::string_view, 3> kNames{"light", "moderate", "heavy"};
    return name_in(kNames, intensity);
}

std::string_view name(Descriptor descriptor) noexcept {
    return name_in(kDescriptorCodes, descriptor);
}

std::string_view name(Phenomenon phenomenon) noexcept {
    return name_in(kPhenomenonCodes, phenomenon);
}

std::string_view name(CloudAmount amount) noexcept {
    return name_in(kAmountCodes, amount);
}

std::string_view name(ClearCode code) noexcept {
    return name_in(kClearCodes, code);
}

std::string_view name(SpeedUnit unit) noexcept {
    return name_in(kSpeedUnits, unit);
}

std::string_view compass_name(int direction_deg) noexcept {
    return name_in(kCompass, direction_deg / 45);
}

Oktas oktas(CloudAmount amount) noexcept {
    switch (amount) {
        case CloudAmount::kFew:
            return {1, 2};
        case CloudAmount::kScattered:
            return {3, 4};
        case CloudAmount::kBroken:
            return {5, 7};
        case CloudAmount::kOvercast:
        case CloudAmount::kEnd:
            break;
    }
    return {8, 8};
}

double coverage_percent(CloudAmount amount) noexcept {
    const auto [least, most] = oktas(amount);
    return 100.0 * (least + most) / 16.0;
}

double metres_per_second(int speed, SpeedUnit unit) noexcept {
    switch (unit) {
        case SpeedUnit::kKnots:
            return speed * 0.514444;
        case SpeedUnit::kKilometresPerHour:
            return speed / 3.6;
        case SpeedUnit::kMetresPerSecond:
            break;
    }
    return speed;
}

}  // namespace skyig::protocol::metar
