#include "render/deferred_pass.h"

#include <array>
#include <cstring>
#include <span>
#include <vector>

namespace skyig::render {

namespace {

using Table = sky::models::AerialTable;

std::span<const float> floats(const std::vector<Table::Texel>& texels) {
    return {texels.front().data(), texels.size() * 4};
}

constexpr int kVeilColumns = static_cast<int>(fog::Veil::kMostSegments);
constexpr int kVeilRows = 6;

gl::Texture colours() {
    return {gl::TexelFormat::kRgba32F, Table::kColumns, Table::kRows, Table::kSlices};
}

}  // namespace

DeferredPass::DeferredPass()
    : program_("sky/deferred.vert", "sky/deferred.frag"),
      triangle_({}, 3),
      tone_(program_, true),
      map_{program_.uniform("u_map.eye_radius_m"),    program_.uniform("u_map.outside_m2"),
           program_.uniform("u_map.inside_radius_m"), program_.uniform("u_map.horizon_sine"),
           program_.uniform("u_map.scale"),           program_.uniform("u_map.rise_m"),
           program_.uniform("u_map.fall_m"),          program_.uniform("u_map.longest_m")},
      sources_{{{program_.uniform("u_source_enu[0]"), program_.uniform("u_source_rgb[0]")},
                {program_.uniform("u_source_enu[1]"), program_.uniform("u_source_rgb[1]")}}},
      haze_g_(program_.uniform("u_haze_g")),
      source_count_(program_.uniform("u_source_count")),
      even_(program_.uniform("u_even_cd_m2")),
      dither_(program_.uniform("u_dither_codes")),
      centre_(program_.uniform("u_far_centre")),
      right_(program_.uniform("u_far_right")),
      up_(program_.uniform("u_far_up")),
      extinction_(gl::TexelFormat::kRgba32F, Table::kDepths, Table::kRows),
      rest_{colours(), colours()},
      haze_{colours(), colours()},
      veil_{program_.uniform("u_veil_count"),
            program_.uniform("u_veil_radius_m"),
            program_.uniform("u_veil_slants"),
            program_.uniform("u_veil_molecules"),
            program_.uniform("u_veil_aerosol"),
            program_.uniform("u_veil_above_m"),
            {program_.uniform("u_veil_lux[0]"), program_.uniform("u_veil_lux[1]")},
            {program_.uniform("u_veil_enu[0]"), program_.uniform("u_veil_enu[1]")},
            {program_.uniform("u_veil_beyond[0]"), program_.uniform("u_veil_beyond[1]")}},
      clouds_(program_),
      veil_segments_(gl::TexelFormat::kRgba32F, kVeilColumns, kVeilRows),
      veil_texels_(std::size_t{4} * kVeilColumns * kVeilRows) {
    program_.set(program_.uniform("u_table_size"),
                 glm::vec3{glm::ivec3{Table::kColumns, Table::kRows, Table::kSlices}});
    program_.set(program_.uniform("u_depths"), static_cast<float>(Table::kDepths));
}

void DeferredPass::upload(const DeferredAir& air) {
    const Table& table = air.table();
    extinction_.update(floats(table.extinction()));
    for (std::size_t i = 0; i < table.light_count(); ++i) {
        rest_[i].update(floats(table.colours(i).rest));
        haze_[i].update(floats(table.colours(i).haze));
    }
    const shaders64::AerialMap& map = table.map();
    const std::array values{map.eye_radius_m, map.outside_m2, map.inside_radius_m, map.horizon_sine,
                            map.scale,        map.rise_m,     map.fall_m,          map.longest_m};
    for (std::size_t i = 0; i < values.size(); ++i)
        program_.set(map_[i], static_cast<float>(values[i]));
    program_.set(haze_g_, static_cast<float>(table.haze_g()));
    uploaded_ = air.revision();
}

// A column a segment, as veil_segment() of the shader reads it.
void DeferredPass::upload_veil(const DeferredAir& air) {
    const fog::Veil* veil = air.veil();
    program_.set(veil_.count, veil != nullptr ? static_cast<float>(veil->segments().size()) : 0.0F);
    if (veil == nullptr) return;
    std::size_t column = 0;
    for (const fog::Veil::Segment& segment : veil->segments()) {
        const shaders32::VeilSegment s = fog::single_precision(segment);
        const std::array<glm::vec4, kVeilRows> texels{glm::vec4{s.low_m, s.high_m, s.low_per_m, s.high_per_m},
                                                      glm::vec4{s.low_depth, s.high_depth, s.kept, s.g},
                                                      glm::vec4{s.low_even, s.albedo.x},
                                                      glm::vec4{s.high_even, s.albedo.y},
                                                      glm::vec4{s.low_slope, s.albedo.z},
                                                      glm::vec4{s.high_slope, 0.0F}};
        for (std::size_t row = 0; row < texels.size(); ++row)
            std::memcpy(&veil_texels_[4 * (row * fog::Veil::kMostSegments + column)], &texels[row].x,
                        sizeof(glm::vec4));
        ++column;
    }
    veil_segments_.update(veil_texels_);
    const shaders64::VeilBeams beams = veil->beams(glm::dvec3{0.0, 0.0, 1.0});
    program_.set(veil_.radius, static_cast<float>(veil->eye_radius_m()));
    program_.set(veil_.slants, glm::vec2{glm::dvec2{beams.first_slant, beams.second_slant}});
    const shaders64::VeilAir& front = air.air_before_veil();
    program_.set(veil_.molecules, glm::vec4{glm::dvec4{front.molecules_per_m, front.molecules_height_m}});
    program_.set(veil_.aerosol, glm::vec4{glm::dvec4{front.aerosol_per_m, front.aerosol_height_m}});
    program_.set(veil_.above, static_cast<float>(front.above_m));
    for (std::size_t i = 0; i < 2; ++i) {
        program_.set(veil_.lux[i], glm::vec3{veil->sources().beams[i].lux});
        program_.set(veil_.direction[i], glm::vec3{veil->sources().beams[i].direction_enu});
        program_.set(veil_.beyond[i], glm::vec3{air.beyond_veil_cd_m2(i == 1)});
    }
}

void DeferredPass::prepare(const DeferredAir& air, const CloudFrame& clouds, const GroundShadow& shadow,
                           bool dither) {
    clouds_.prepare(program_, clouds, shadow);
    if (uploaded_ != air.revision()) upload(air);
    for (std::size_t i = 0; i < air.source_count(); ++i) {
        program_.set(sources_[i].direction, glm::vec3{air.source(i).direction_enu});
        program_.set(sources_[i].rgb, glm::mat4{glm::dmat4{air.source(i).rgb}});
    }
    program_.set(source_count_, static_cast<float>(air.source_count()));
    program_.set(even_, glm::vec3{air.even_cd_m2()});
    program_.set(dither_, dither ? 1.0F : 0.0F);
    upload_veil(air);
}

void DeferredPass::draw(const ChannelView& view, const DeferredInput& input,
                        const shaders32::ToneParameters& tone) const {
    tone_.set(program_, tone);
    const ImagePlane p = image_plane(view.frustum);
    const glm::dmat3 enu_from_view = glm::transpose(view.view_from_enu) * input.far_m;
    program_.use();
    program_.set(centre_, glm::vec3{enu_from_view *
                                    glm::dvec3{0.5 * (p.left + p.right), 0.5 * (p.bottom + p.top), -1.0}});
    program_.set(right_, glm::vec3{enu_from_view * glm::dvec3{0.5 * (p.right - p.left), 0.0, 0.0}});
    program_.set(up_, glm::vec3{enu_from_view * glm::dvec3{0.0, 0.5 * (p.top - p.bottom), 0.0}});
    gl::bind_texture(0, input.colour_texture);
    gl::bind_texture(1, input.depth_texture);
    gl::bind_texture(2, extinction_.name());
    for (int i = 0; i < 2; ++i) {
        gl::bind_texture(3 + 2 * i, rest_[static_cast<std::size_t>(i)].name());
        gl::bind_texture(4 + 2 * i, haze_[static_cast<std::size_t>(i)].name());
    }
    gl::bind_texture(7, veil_segments_.name());
    clouds_.bind(program_, input.shadows);
    triangle_.draw_strip(3);
}

}  // namespace skyig::render
