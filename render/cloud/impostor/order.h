// Particles in order of a coordinate, in linear time.
#pragma once

#include <cstdint>
#include <span>

namespace skyig::render::cloud::impostor {

/// \param keys  at most kMostParticles \param order  as many: indices by rising key, equal ones (to 1/512 of
/// the keys' range) as they came
void sort_by(std::span<const float> keys, std::span<std::uint16_t> order) noexcept;

}  // namespace skyig::render::cloud::impostor
