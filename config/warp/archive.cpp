#include "config/warp/archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace skyig::config::warp {
namespace {

constexpr std::size_t kSmall = std::size_t{1} << 20U;

bool leads_out(std::string_view name) {
    if (name.empty() || name.front() == '/' || (name.size() > 1 && name[1] == ':')) return true;
    if (std::any_of(name.begin(), name.end(),
                    [](char c) { return c == '\\' || static_cast<unsigned char>(c) < 32; }))
        return true;
    return name == ".." || name.starts_with("../") || name.ends_with("/..") ||
           name.find("/../") != std::string_view::npos;
}

/// Names go into one line of text.
std::string printable(std::string_view name) {
    std::string text(name.substr(0, 80));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, '?');
    return text;
}

std::string fault_of(zip_t* zip, zip_uint64_t index) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    constexpr zip_uint64_t kWanted = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
    if (zip_stat_index(zip, index, 0, &stat) != 0 || (stat.valid & kWanted) != kWanted)
        return fmt::format("entry {} of the archive is damaged", index + 1);
    const std::string name = printable(stat.name);
    if (leads_out(stat.name)) return fmt::format("entry {}: its name leads out of the archive", name);
    if (stat.size > Archive::kMostEntryBytes)
        return fmt::format("entry {}: unpacks to {} bytes, more than {} MiB", name, stat.size,
                           Archive::kMostEntryBytes >> 20U);
    if (stat.size > kSmall && stat.size / std::max<zip_uint64_t>(stat.comp_size, 1) > Archive::kMostRatio)
        return fmt::format("entry {}: unpacks {} bytes to {}, more than {} to one", name, stat.comp_size,
                           stat.size, Archive::kMostRatio);
    return {};
}

}  // namespace

struct Archive::Handle {
    Bytes bytes;  // that libzip reads from
    zip_t* zip = nullptr;
};

void Archive::Close::operator()(Handle* handle) const noexcept {
    if (handle->zip != nullptr) zip_discard(handle->zip);
    delete handle;
}

Archive::Archive(std::unique_ptr<Handle, Close> handle) : handle_(std::move(handle)) {}

FileRead<Archive> Archive::open(Bytes bytes) {
    std::unique_ptr<Handle, Close> handle(new Handle{std::move(bytes)});
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(handle->bytes.data(), handle->bytes.size(), 0, &error);
    if (source != nullptr) handle->zip = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
    if (handle->zip == nullptr) {
        if (source != nullptr) zip_source_free(source);
        std::string fault = fmt::format("is no whole ZIP archive: {}", zip_error_strerror(&error));
        zip_error_fini(&error);
        return {std::nullopt, std::move(fault)};
    }
    zip_error_fini(&error);
    const zip_int64_t entries = zip_get_num_entries(handle->zip, 0);
    if (entries == 0) return {std::nullopt, "is no whole ZIP archive: it has no entries"};
    if (entries > kMostEntries)
        return {std::nullopt, fmt::format("has {} entries, more than {}", entries, kMostEntries)};
    for (zip_int64_t i = 0; i < entries; ++i) {
        std::string fault = fault_of(handle->zip, static_cast<zip_uint64_t>(i));
        if (!fault.empty()) return {std::nullopt, std::move(fault)};
    }
    return {Archive(std::move(handle)), {}};
}

FileRead<Bytes> Archive::read(const std::string& entry) const {
    const auto refused = [&](std::string_view why) {
        return FileRead<Bytes>{std::nullopt, fmt::format("entry {}: {}", printable(entry), why)};
    };
    const zip_int64_t index = zip_name_locate(handle_->zip, entry.c_str(), ZIP_FL_NOCASE);
    if (index < 0) return refused("is not in the archive");
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat_index(handle_->zip, static_cast<zip_uint64_t>(index), 0, &stat) != 0)
        return refused("is damaged");
    struct Closed {
        void operator()(zip_file_t* file) const noexcept { zip_fclose(file); }
    };
    const std::unique_ptr<zip_file_t, Closed> file(
        zip_fopen_index(handle_->zip, static_cast<zip_uint64_t>(index), 0));
    if (!file) return refused(zip_strerror(handle_->zip));
    // One byte more than it says, so that the end is read, and with it the check sum.
    Bytes bytes(stat.size + 1);
    std::size_t held = 0;
    while (held < bytes.size()) {
        const zip_int64_t got = zip_fread(file.get(), bytes.data() + held, bytes.size() - held);
        if (got < 0) return refused(zip_file_strerror(file.get()));
        if (got == 0) break;
        held += static_cast<std::size_t>(got);
    }
    if (held != stat.size) return refused("is not as long as it says");
    bytes.resize(held);
    return {std::move(bytes), {}};
}

}  // namespace skyig::config::warp
