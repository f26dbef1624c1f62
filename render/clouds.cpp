#include "render/clouds.h"

#include "render/light_on_clouds.h"
#include "render/scene_cloud_maker.h"

namespace skyig::render {

Clouds scene_clouds() {
    return {std::make_unique<SceneCloudMaker>(), &light_clouds};
}

}  // namespace skyig::render
