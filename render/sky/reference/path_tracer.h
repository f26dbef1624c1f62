// Light at one point, followed backwards through the air until it is seen to come from the Sun. One path
// serves all wavelengths: it is drawn for one of them (the hero, chosen at random) and weighed by the density
// that all of them together would have drawn it with (the balance heuristic over heroes: Wilkie et al., EGSR
// 2014).
#pragma once

#include <glm/glm.hpp>

#include "render/sky/reference/medium.h"
#include "render/sky/reference/sampler.h"

namespace skyig::render::sky::reference {

/// A point of the shell: its height, and the vertical there.
struct Place {
    double height_m = 0.0;
    glm::dvec3 up{0.0, 0.0, 1.0};
};

/// A ray from an eye, also above the lid; the direction is a unit vector of the same frame as `up`.
struct ViewRay {
    Place eye;
    glm::dvec3 direction{0.0, 0.0, 1.0};
};

/// Radiances are per unit of the Sun's irradiance outside the air (1/sr). The Sun is a point.
class PathTracer {
  public:
    /// \param sun  unit vector towards it
    PathTracer(const Medium& medium, const glm::dvec3& sun);

    /// Light scattered once, and ground that the Sun lights directly, by quadrature along the ray.
    [[nodiscard]] Samples first_order(const ViewRay& ray) const;
    /// What one path finds of all later orders. Without bias: the mean over paths is the radiance.
    [[nodiscard]] Samples later_orders(const ViewRay& ray, Sampler& sampler) const;
    /// What one path finds of the irradiance of level ground by the sky, over pi.
    [[nodiscard]] Samples sky_on_ground(Sampler& sampler) const;
    /// Part of the sunlight that arrives; all zero where the Earth is in the way.
    [[nodiscard]] Samples sunlight(const Place& place) const;

  private:
    enum class Event { kAir, kGround, kGone };

    struct Walk {
        Place place;
        glm::dvec3 direction{0.0};
        std::size_t hero = 0;
        Triple density;  // at the last collision
        Samples value{};
        Samples drawn{};            // probability density of the path so far with each hero, over that of all
        double least_worth = -1.0;  // below it the roulette begins
    };

    [[nodiscard]] Samples sunlight(const Place& place, int cells) const;
    [[nodiscard]] Walk start(const ViewRay& ray, Sampler& sampler) const;
    /// To the next collision; `whole_m`: to one for sure, the ray having this column and no ground.
    Event advance(Walk& walk, double random, const Triple* whole_m) const;
    /// Gathers light from event to event until the path ends.
    void follow(Walk& walk, Event event, bool skip_first, Sampler& sampler, Samples& light) const;
    void add_sunlight(const Walk& walk, Event event, Samples& light) const;
    void turn_in_air(Walk& walk, Sampler& sampler) const;
    static void turn_at_ground(Walk& walk, Sampler& sampler);
    /// Russian roulette; false where the path ends.
    bool survives(Walk& walk, Sampler& sampler) const;
    [[nodiscard]] double aerosol_cosine(Sampler& sampler) const;

    const Medium& medium_;
    glm::dvec3 sun_;
    /// How much each wavelength counts, and how often each is the hero; both add up to 1.
    Samples importance_{};
    Samples hero_share_{};
};

}  // namespace skyig::render::sky::reference
