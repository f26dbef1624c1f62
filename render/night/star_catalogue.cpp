#include "render/night/star_catalogue.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace skyig::render::night {
namespace {

constexpr CatalogueStar kStars[] = {
#include "star_table.inc"
};
static_assert(std::size(kStars) == kCatalogueStarCount);

}  // namespace

std::span<const CatalogueStar> star_catalogue() noexcept {
    return kStars;
}

glm::dvec3 direction_at(const CatalogueStar& star, double years_since_j2000) noexcept {
    return glm::normalize(glm::dvec3(star.direction_gcrs) +
                          years_since_j2000 * glm::dvec3(star.proper_motion_rad_yr));
}

const CatalogueStar* find_star(int hr) noexcept {
    const auto* const found =
        std::lower_bound(std::begin(kStars), std::end(kStars), hr,
                         [](const CatalogueStar& star, int number) { return star.hr < number; });
    return found != std::end(kStars) && found->hr == hr ? found : nullptr;
}

}  // namespace skyig::render::night
