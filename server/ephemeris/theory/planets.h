// Where a planet stands in the tables of the theories.
#pragma once

#include <cstddef>
#include <optional>

#include "server/ephemeris/bodies.h"

namespace skyig::server::ephemeris::theory {

/// 0 for Mercury to 4 for Saturn; nothing for Sun and Moon.
[[nodiscard]] constexpr std::optional<std::size_t> planet_row(Body body) noexcept {
    if (index_of(body) < index_of(Body::kMercury) || index_of(body) >= kBodyCount) return std::nullopt;
    return index_of(body) - index_of(Body::kMercury);
}

}  // namespace skyig::server::ephemeris::theory
