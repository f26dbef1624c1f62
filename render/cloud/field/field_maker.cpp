#include "render/cloud/field/field_maker.h"

#include "render/cloud/snapshot.h"

namespace skyig::render::cloud::field {

FieldMaker::FieldMaker() : fields_(kSlots, CloudField(std::make_shared<const Matrix>())) {}

const CloudSource& FieldMaker::freeze(std::size_t slot, const CloudMoment& moment) {
    scene_ = moment.scene;
    scene_.eye = moment.eye;
    // Places are told from the eye.
    const glm::dvec2 moved_m{eye_offset_m(moment.scene.eye, moment.eye)};
    Weather& weather = scene_.weather;
    for (std::size_t i = 0; i < weather.cloud_count; ++i) {
        if (weather.clouds[i].area) weather.clouds[i].area->centre_m -= moved_m;
    }
    fields_[slot].freeze(scene_, moment.light);
    return fields_[slot];
}

}  // namespace skyig::render::cloud::field
