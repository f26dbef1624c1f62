// What clouds make of a display code: code * .a + .rgb. The two squares lie one above the other in the texture.
#include "common/scalar.glsl"
#include "cloud/map.glsl"

layout(binding = 7) uniform sampler2D u_clouds;
uniform vec4 u_cloud_place;      // (scale, shift) of a place to the texture's x, then to its y

vec4 clouds_at(vec3 direction) {
    vec2 place = cloud_map_place(direction);
    float shift = direction.z < 0.0 ? u_cloud_place.w + 0.5 : u_cloud_place.w;
    return texture(u_clouds, vec2(place.x * u_cloud_place.x + u_cloud_place.y, place.y * u_cloud_place.z + shift));
}
