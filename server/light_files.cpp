#include "server/light_files.h"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "render/output/light_file.h"
#include "server/from_config.h"
#include "server/gl_painter.h"

namespace skyig::server {

namespace {

class LightFiles {
  public:
    explicit LightFiles(GlSeatSettings settings) : settings_(std::move(settings)) {}

    bool write(const std::string& path, const ImageWriter::Frame& frame, std::size_t channel,
               std::string& error) {
        try {
            draw(frame, channel);
        } catch (const std::exception& failure) {
            error = fmt::format("{}: {}", path, failure.what());
            return false;
        }
        if (painter_->health(channel).failed) {
            error = fmt::format("{}: {}", path, painter_->health(channel).reason());
            return false;
        }
        const render::Channel& shape = settings_.channels[channel];
        return render::output::write_light(path, shape.width_px, shape.height_px, rgb_cd_m2_, error);
    }

    void see(const ImageWriter::Frame& frame) {
        try {
            prepare(frame);
        } catch (const std::exception&) {
            // The next file says what is wrong.
            painter_.reset();
        }
    }

  private:
    void prepare(const ImageWriter::Frame& frame) {
        if (!painter_) painter_ = std::make_unique<GlPainter>(settings_);
        if (prepared_ != frame.number) painter_->prepare(frame.scene);
        prepared_ = frame.number;
    }

    void draw(const ImageWriter::Frame& frame, std::size_t channel) {
        prepare(frame);
        const render::Channel& shape = settings_.channels[channel];
        rgb_cd_m2_.resize(static_cast<std::size_t>(shape.width_px) *
                          static_cast<std::size_t>(shape.height_px) * 3);
        painter_->draw(channel);
        painter_->read_luminance(channel, rgb_cd_m2_);
    }

    GlSeatSettings settings_;
    // Made by the first file, so that its context is the writing thread's.
    std::unique_ptr<GlPainter> painter_;
    std::optional<std::uint64_t> prepared_;
    std::vector<float> rgb_cd_m2_;
};

}  // namespace

ImageWriter::Files light_files(const config::Config& config) {
    auto files = std::make_shared<LightFiles>(GlSeatSettings{.channels = render_channels(config),
                                                             .display = display_settings(config),
                                                             .quality = quality(config),
                                                             .target = render::Target::kLuminance});
    return {[files](const std::string& path, const ImageWriter::Frame& frame, std::size_t channel,
                    std::string& error) { return files->write(path, frame, channel, error); },
            [files](const ImageWriter::Frame& frame) { files->see(frame); }};
}

}  // namespace skyig::server
