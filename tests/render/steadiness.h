// Whether a replayed flight flickers: what changes from one drawn frame to the next while the view stands
// still.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "render/renderer.h"
#include "tests/render/flights.h"

namespace skyig::render::tests {

struct Steps {
    int largest = 0;  ///< of any byte of any pixel, display codes
    int at_frame = 0;
    double brightness = 0.0;  ///< of a channel's mean, display codes
};

/// Draws frames [first, first + count) of a flight at 160x128, ahead and astern, without discs.
inline Steps largest_step(const Flight& flight, int first, int count) {
    const std::vector<Channel> channels{{"ahead", 160, 128}, {"astern", 160, 128}};
    DisplaySettings display;
    display.dither = false;
    Renderer renderer(channels, display);
    constexpr std::size_t kBytes = std::size_t{160} * 128 * 4;
    std::vector<std::vector<std::byte>> last(channels.size(), std::vector<std::byte>(kBytes));
    std::vector<std::byte> now(kBytes);
    Steps steps;
    for (int frame = first; frame < first + count; ++frame) {
        Scene scene = flight.scene(frame);
        scene.sun.enabled = scene.moon.enabled = false;
        for (const double yaw_deg : {200.0, 20.0})
            add_view(scene, symmetric_frustum(40.0, 160, 128), view_from_enu(yaw_deg, 8.0, 0.0));
        renderer.prepare(scene);
        for (std::size_t i = 0; i < channels.size(); ++i) {
            renderer.draw(i);
            renderer.read_back(i, now);
            double sum = 0.0;
            for (std::size_t k = 0; frame > first && k < kBytes; ++k) {
                const int change = std::to_integer<int>(now[k]) - std::to_integer<int>(last[i][k]);
                sum += change;
                if (std::abs(change) <= steps.largest) continue;
                steps.largest = std::abs(change);
                steps.at_frame = frame;
            }
            // A quarter of the bytes never changes: it is alpha.
            steps.brightness = std::max(steps.brightness, std::abs(sum) / (0.75 * kBytes));
            std::swap(last[i], now);
        }
    }
    return steps;
}

}  // namespace skyig::render::tests
