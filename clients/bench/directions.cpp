#include "clients/bench/directions.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace skyig::clients::bench {

std::shared_ptr<const std::array<glm::vec2, kDirections>> directions() {
    std::mt19937 random(60);
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    auto made = std::make_shared<std::array<glm::vec2, kDirections>>();
    for (glm::vec2& direction : *made)
        direction = {static_cast<float>(std::asin(part(random))),
                     static_cast<float>(std::numbers::pi * part(random))};
    return made;
}

Work one_colour_floor() {
    return repeat([asked = directions()](std::uint64_t i) {
        const glm::vec2& direction = (*asked)[i % kDirections];
        // Whoever looks up has to have read the direction.
        __asm__ volatile("" : : "x"(direction.x), "x"(direction.y));
        return 1.0;
    });
}

}  // namespace skyig::clients::bench
