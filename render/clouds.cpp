#include "render/clouds.h"

#include "render/cloud/field/field_maker.h"
#include "render/light_on_clouds.h"

namespace skyig::render {

Clouds scene_clouds() {
    return {std::make_unique<cloud::field::FieldMaker>(), &light_clouds};
}

}  // namespace skyig::render
