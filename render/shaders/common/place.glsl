// Where a channel shows what stands at a place of its frustum's flat picture: there, unless the channel is warped
// (render/warp/warp.h). Places are in clip space, -1..1 across what is shown.
#ifdef SKYIG_WARPED
layout(binding = 13) uniform sampler2D u_warp;
layout(std140, binding = 0) uniform Warp { vec4 u_warp_node; };  // (scale, shift) of a place to a node's number

// (right, up) to where it is shown; the size of a bit of the picture over that of the bit of screen that shows it.
vec3 moved_at(vec2 place) {
    ivec2 last = textureSize(u_warp, 0) - 1;
    vec2 at = clamp(place * u_warp_node.xy + u_warp_node.zw, vec2(0.0), vec2(last));
    ivec2 low = min(ivec2(at), last - 1);
    vec2 share = at - vec2(low);
    vec3 below = mix(texelFetch(u_warp, low, 0).xyz, texelFetch(u_warp, low + ivec2(1, 0), 0).xyz, share.x);
    vec3 above = mix(texelFetch(u_warp, low + ivec2(0, 1), 0).xyz, texelFetch(u_warp, low + 1, 0).xyz, share.x);
    return mix(below, above, share.y);
}

// Of what stands beside or behind the eye nothing is known: nothing of it shows, and towards it the move fades.
vec4 placed(vec4 position) {
    float ahead = max(position.w, 0.0);
    return vec4(position.xy + moved_at(position.xy / max(ahead, 1e-6)).xy * ahead, position.zw);
}
#else
vec3 moved_at(vec2 place) { return vec3(0.0, 0.0, 1.0); }
vec4 placed(vec4 position) { return position; }
#endif
