#include "config/warp/mpcdi.h"

#include <fmt/format.h>
#include <strings.h>

#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "config/channel.h"
#include "config/warp/archive.h"
#include "config/warp/float_map.h"
#include "config/warp/grey_map.h"

namespace skyig::config::warp {
namespace {

constexpr const char* kXml = "mpcdi.xml";
/// As a tree it takes twenty times as much.
constexpr std::size_t kMostXmlBytes = std::size_t{4} << 20U;

/// What is wrong, on its way to read_mpcdi() alone.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

[[noreturn]] void refuse(const std::string& fault) {
    throw Refused(fault);
}

template <class T>
T taken(FileRead<T> read, std::string_view entry = {}) {
    if (read.value) return std::move(*read.value);
    refuse(entry.empty() ? read.fault : fmt::format("entry {}: {}", entry, read.fault));
}

// Writers do not agree on capitals.
pugi::xml_node child_of(const pugi::xml_node& node, const char* name) {
    return node.find_child([&](const pugi::xml_node& child) { return strcasecmp(child.name(), name) == 0; });
}

std::string_view attribute_of(const pugi::xml_node& node, const char* name) {
    const pugi::xml_attribute attribute = node.find_attribute(
        [&](const pugi::xml_attribute& each) { return strcasecmp(each.name(), name) == 0; });
    return attribute.value();
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

double number_of(std::string_view text, std::string_view what, double least, double most) {
    const std::string_view bare = trimmed(text);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
    if (error != std::errc{} || stop != bare.data() + bare.size() || !(value >= least && value <= most))
        refuse(fmt::format("entry {}: {} is \"{}\"; it must be a number in {}..{}", kXml, what,
                           bare.substr(0, 40), least, most));
    return value;
}

double element_of(const pugi::xml_node& node, const char* name, double most) {
    const pugi::xml_node child = child_of(node, name);
    if (!child) refuse(fmt::format("entry {}: <{}> has no <{}>", kXml, node.name(), name));
    return number_of(child.text().get(), name, -most, most);
}

class Reader {
  public:
    Reader(Bytes bytes, const std::string& region) : archive_(taken(Archive::open(std::move(bytes)))) {
        read_document();
        find_region(region);
    }

    MpcdiRegion read() {
        MpcdiRegion out;
        out.width_px = pixels("xResolution");
        out.height_px = pixels("yResolution");
        if (is_3d_)
            out.view = view();
        else
            out.part = {attribute(region_, "x", 0.0, 1.0), attribute(region_, "y", 0.0, 1.0),
                        attribute(region_, "xsize", 1e-3, 1.0), attribute(region_, "ysize", 1e-3, 1.0)};
        // Written in decimals, thirds add up to a little more.
        if (!is_3d_ && (out.part[0] + out.part[2] > 1.0 + 1e-6 || out.part[1] + out.part[3] > 1.0 + 1e-6))
            refuse(fmt::format(
                "entry {}: <region> goes beyond its picture: x + xsize and y + ysize must be at most 1",
                kXml));
        read_files(out);
        return out;
    }

  private:
    static double attribute(const pugi::xml_node& node, const char* name, double least, double most) {
        return number_of(attribute_of(node, name), fmt::format("{} of <{}>", name, node.name()), least, most);
    }

    [[nodiscard]] int pixels(const char* name) const {
        const double count = attribute(region_, name, 1.0, kMaxChannelSize_px);
        if (count != std::floor(count))
            refuse(
                fmt::format("entry {}: {} of <region> is {}; it must be a whole number", kXml, name, count));
        return static_cast<int>(count);
    }

    void read_document() {
        const Bytes text = taken(archive_.read(kXml));
        if (text.size() > kMostXmlBytes)
            refuse(fmt::format("entry {}: has {} bytes, more than {} MiB", kXml, text.size(),
                               kMostXmlBytes >> 20U));
        const pugi::xml_parse_result parsed = document_.load_buffer(text.data(), text.size());
        if (!parsed)
            refuse(fmt::format("entry {}: {} at byte {}", kXml, parsed.description(), parsed.offset));
        root_ = child_of(document_, "MPCDI");
        if (!root_) refuse(fmt::format("entry {}: has no <MPCDI>", kXml));
        const std::string_view version = attribute_of(root_, "version");
        if (!version.starts_with("1.") && !version.starts_with("2."))
            refuse(fmt::format("entry {}: is of version \"{}\"; 1.0 and 2.0 are read", kXml,
                               version.substr(0, 20)));
        const std::string_view profile = attribute_of(root_, "profile");
        is_3d_ = profile == "3d";
        if (!is_3d_ && profile != "2d")
            refuse(fmt::format("entry {}: is of profile \"{}\"; \"3d\" (simulation) and \"2d\" are read",
                               kXml, profile.substr(0, 20)));
    }

    void find_region(const std::string& wanted) {
        std::string names;
        int count = 0;
        for (const pugi::xml_node& buffer : child_of(root_, "display").children()) {
            for (const pugi::xml_node& region : buffer.children()) {
                if (strcasecmp(region.name(), "region") != 0) continue;
                const std::string_view id = attribute_of(region, "id");
                names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", id.substr(0, 40));
                ++count;
                if (id == wanted || wanted.empty()) region_ = region;
            }
        }
        if (count == 0) refuse(fmt::format("entry {}: has no region", kXml));
        if (wanted.empty() && count > 1)
            refuse(fmt::format("entry {}: has {} regions, {}; the key region must name one", kXml, count,
                               names));
        if (!region_) refuse(fmt::format("entry {}: has no region \"{}\", only {}", kXml, wanted, names));
    }

    MpcdiRegion::View view() const {
        const pugi::xml_node frustum = child_of(region_, "frustum");
        if (!frustum) refuse(fmt::format("entry {}: the region has no <frustum>", kXml));
        const auto side = [&](const char* name) { return element_of(frustum, name, kMaxHalfAngle_deg); };
        MpcdiRegion::View view{{side("leftAngle"), side("rightAngle"), side("downAngle"), side("upAngle")},
                               {element_of(frustum, "yaw", 360.0), element_of(frustum, "pitch", 90.0),
                                element_of(frustum, "roll", 180.0)}};
        if (view.sides_deg[0] >= view.sides_deg[1] || view.sides_deg[2] >= view.sides_deg[3])
            refuse(
                fmt::format("entry {}: the frustum has no area: left and down must be below right and up "
                            "(they are normally negative)",
                            kXml));
        return view;
    }

    std::string path_of(const pugi::xml_node& file) const {
        const std::string_view path = trimmed(child_of(file, "path").text().get());
        if (path.empty()) refuse(fmt::format("entry {}: <{}> has no <path>", kXml, file.name()));
        return std::string(path);
    }

    GreyMap mask(const pugi::xml_node& file, const MpcdiRegion& region) const {
        const std::string path = path_of(file);
        const GreyMap map = taken(read_grey_map(taken(archive_.read(path)), MaskPart::kGrey), path);
        return stretched(map, region.width_px, region.height_px);
    }

    void read_files(MpcdiRegion& out) const {
        for (const pugi::xml_node& set : child_of(root_, "files").children()) {
            if (attribute_of(set, "region") != attribute_of(region_, "id")) continue;
            if (const pugi::xml_node file = child_of(set, "geometryWarpFile"); file) {
                const std::string path = path_of(file);
                const FloatMap map = taken(read_float_map(taken(archive_.read(path))), path);
                out.warp = taken(warp_mesh(map, false), path);
            }
            const pugi::xml_node alpha = child_of(set, "alphaMap");
            const pugi::xml_node beta = child_of(set, "betaMap");
            if (!alpha && !beta) continue;
            BlendMask& blend = out.blend.emplace(BlendMask{out.width_px, out.height_px, {}});
            blend.weight.assign(
                static_cast<std::size_t>(out.width_px) * static_cast<std::size_t>(out.height_px), 1.0F);
            if (alpha) {
                const pugi::xml_node gamma = child_of(alpha, "gammaEmbedded");
                const auto power = static_cast<float>(
                    gamma ? number_of(gamma.text().get(), "gammaEmbedded", 0.1, 10.0) : 1.0);
                blend.weight = mask(alpha, out).values;
                for (float& weight : blend.weight)
                    weight = std::pow(weight, power);
            }
            if (beta) blend.lift = mask(beta, out).values;
        }
    }

    Archive archive_;
    pugi::xml_document document_;
    pugi::xml_node root_;
    pugi::xml_node region_;
    bool is_3d_ = false;
};

}  // namespace

FileRead<MpcdiRegion> read_mpcdi(Bytes archive, const std::string& region) {
    try {
        return {Reader(std::move(archive), region).read(), {}};
    } catch (const Refused& refused) {
        return {std::nullopt, refused.what()};
    }
}

}  // namespace skyig::config::warp
