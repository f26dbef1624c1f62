#include "clients/skyig/ephem/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "clients/body_name.h"
#include "clients/csv.h"
#include "clients/letters.h"
#include "clients/row_time.h"
#include "clients/skyig/ephem/body_place.h"
#include "clients/skyig/ephem/told_angle.h"
#include "render/sky/refraction.h"

namespace skyig::clients::ephem {

using server::ephemeris::Body;
using server::ephemeris::Geodetic;
using server::ephemeris::Instant;

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kMostOffset_s = 3600.0;

/// Why a row is bad; `column` is empty when it is the row as a whole.
struct RowProblem {
    std::string column;
    std::string text;
};

struct TimeColumn {
    std::string_view name;
    TimeForm form;
};
constexpr std::array<TimeColumn, 4> kTimeColumns{{{"utc", TimeForm::kUtc},
                                                  {"date_ut", TimeForm::kUtc},
                                                  {"jd_tt", TimeForm::kTtJulianDate},
                                                  {"td_iso", TimeForm::kTtCivil}}};

using ColumnIndex = std::optional<std::size_t>;

struct Columns {
    std::vector<std::string> names;
    std::size_t time = 0;
    TimeForm form = TimeForm::kUtc;
    ColumnIndex body;
    ColumnIndex latitude;
    ColumnIndex longitude;
    ColumnIndex height;
    ColumnIndex tt_minus_utc;
    ColumnIndex ut1_minus_utc;
    ColumnIndex delta_t;

    /// The first that is there, in capitals or not.
    [[nodiscard]] ColumnIndex find(std::initializer_list<std::string_view> wanted) const {
        for (const std::string_view name : wanted) {
            const auto at = std::find_if(names.begin(), names.end(), [name](std::string_view there) {
                return same_letters(there, name);
            });
            if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
        }
        return std::nullopt;
    }
};

void find_time(Columns& columns, const std::string& asked) {
    if (!asked.empty()) {
        const ColumnIndex at = columns.find({asked});
        if (!at) throw std::runtime_error(fmt::format("no column '{}' (--time-column)", asked));
        columns.time = *at;
        const auto* const usual =
            std::find_if(kTimeColumns.begin(), kTimeColumns.end(),
                         [&](const TimeColumn& column) { return same_letters(column.name, asked); });
        if (usual != kTimeColumns.end()) columns.form = usual->form;
        return;
    }
    for (const TimeColumn& column : kTimeColumns) {
        if (const ColumnIndex at = columns.find({column.name})) {
            columns.time = *at;
            columns.form = column.form;
            return;
        }
    }
    throw std::runtime_error(
        "no time column: one has to be called utc, date_ut, jd_tt or td_iso, or be named by --time-column");
}

std::string too_long_text() {
    return fmt::format("the line is longer than {} bytes", kMostLineBytes);
}

Columns read_heading(const CsvRecord& heading, const std::string& asked_time) {
    if (heading.too_long) throw std::runtime_error(too_long_text());
    if (!heading.well_formed) throw std::runtime_error("a quote in the heading is not closed");
    Columns columns;
    columns.names = heading.fields;
    for (const std::string_view name : kBatchColumns) {
        if (columns.find({name})) throw std::runtime_error(fmt::format("column '{}' is there already", name));
    }
    find_time(columns, asked_time);
    columns.body = columns.find({"body"});
    columns.latitude = columns.find({"lat_deg"});
    columns.longitude = columns.find({"lon_deg"});
    columns.height = columns.find({"h_m"});
    if (columns.latitude.has_value() != columns.longitude.has_value())
        throw std::runtime_error(fmt::format("a place needs both columns lat_deg and lon_deg; {} is missing",
                                             columns.latitude ? "lon_deg" : "lat_deg"));
    columns.tt_minus_utc = columns.find({"tt_minus_utc_s", "tt_minus_ut_s"});
    columns.ut1_minus_utc = columns.find({"ut1_minus_utc_s", "ut1_minus_ut_s"});
    columns.delta_t = columns.find({"delta_t_s", "catalog_delta_t_s"});
    return columns;
}

/// One record by the heading's columns; throws RowProblem.
class Row {
  public:
    Row(const Columns& columns, const CsvRecord& record) : columns_(columns), record_(record) {
        if (record.too_long) throw RowProblem{"", too_long_text()};
        if (!record.well_formed)
            throw RowProblem{"", "a quote is not closed on its line, or text follows it: write \"...\""};
        if (record.fields.size() != columns.names.size())
            throw RowProblem{"", fmt::format("{} fields where the heading has {}", record.fields.size(),
                                             columns.names.size())};
    }

    [[nodiscard]] Instant instant() const {
        RowOffsets offsets;
        offsets.tt_minus_utc_s = optional_number(columns_.tt_minus_utc, kMostOffset_s);
        offsets.ut1_minus_utc_s = optional_number(columns_.ut1_minus_utc, kMostOffset_s);
        offsets.delta_t_s = optional_number(columns_.delta_t, kMostOffset_s);
        const std::string& text = record_.fields[columns_.time];
        const std::optional<Instant> found = parse_row_time(text, columns_.form, offsets);
        if (!found)
            throw problem(columns_.time,
                          fmt::format("'{}' is no time; write it as {}", text, example_of(columns_.form)));
        if (found->clamped || !is_in_years(found->tt))
            throw problem(columns_.time, fmt::format("'{}' is outside the years {}..{} that are known", text,
                                                     kFirstYear, kLastYear));
        return *found;
    }

    [[nodiscard]] Body body(Body otherwise) const {
        if (!columns_.body) return otherwise;
        const std::string& text = record_.fields[*columns_.body];
        if (const std::optional<Body> found = parse_body(text)) return *found;
        throw problem(*columns_.body, fmt::format("'{}' is none of {}", text, body_list()));
    }

    [[nodiscard]] std::optional<Geodetic> site(const std::optional<Geodetic>& otherwise) const {
        if (columns_.form == TimeForm::kTtJulianDate) return std::nullopt;
        if (!columns_.latitude) return otherwise;
        Geodetic site;
        site.latitude_deg = number(*columns_.latitude, -90.0, 90.0);
        site.longitude_deg = number(*columns_.longitude, -360.0, 360.0);
        if (columns_.height)
            site.height_m = number(*columns_.height, server::ephemeris::kMinEyeHeight_m,
                                   server::ephemeris::kMaxEyeHeight_m);
        return site;
    }

  private:
    [[nodiscard]] RowProblem problem(std::size_t column, std::string text) const {
        return {columns_.names[column], std::move(text)};
    }

    [[nodiscard]] double number(std::size_t column, double least, double most) const {
        const std::string& text = record_.fields[column];
        const std::optional<double> value = parse_number(text);
        if (!value || *value < least || *value > most)
            throw problem(column, fmt::format("'{}' is not a number in [{:.9g}, {:.9g}]", text, least, most));
        return *value;
    }

    [[nodiscard]] std::optional<double> optional_number(const ColumnIndex& column, double most) const {
        if (!column || record_.fields[*column].empty()) return std::nullopt;
        return number(*column, -most, most);
    }

    const Columns& columns_;
    const CsvRecord& record_;
};

class RowWriter {
  public:
    explicit RowWriter(const AirSettings& air) : air_(air) {}

    [[nodiscard]] std::string columns_of(const BodyPlace& place, const std::optional<Geodetic>& site) const {
        std::string text;
        const auto add = [&text](double value, int decimals) {
            text += fmt::format(",{:.{}f}", value, decimals);
        };
        const auto add_in_circle = [&text](double angle_deg, int decimals) {
            text += ',' + told_in_circle(angle_deg, decimals);
        };
        add_in_circle(place.right_ascension_deg, 9);
        add(place.declination_deg, 9);
        if (place.horizontal && site) {
            add_in_circle(place.horizontal->azimuth_deg, 9);
            add(place.horizontal->elevation_deg, 9);
            add(refracted_deg(place.horizontal->elevation_deg, site->height_m), 9);
        } else {
            text += ",,,";
        }
        add(place.range_km, 4);
        add(place.semidiameter_arcsec, 6);
        add(place.phase_angle_deg, 8);
        add(place.illuminated_fraction, 9);
        if (place.bright_limb_deg) {
            add_in_circle(*place.bright_limb_deg, 7);
        } else {
            text += ',';
        }
        add(place.magnitude, 4);
        add_face(text, place.moon_face);
        return text;
    }

    [[nodiscard]] static std::string empty_columns() { return std::string(kBatchColumns.size(), ','); }

  private:
    static void add_face(std::string& text, const std::optional<MoonFace>& face) {
        if (!face) {
            text += ",,,,,";
            return;
        }
        for (const double angle_deg : {face->subearth_longitude_deg, face->subearth_latitude_deg,
                                       face->subsolar_longitude_deg, face->subsolar_latitude_deg})
            text += fmt::format(",{:.7f}", angle_deg);
        text += ',' + told_in_circle(face->axis_position_angle_deg, 7);
    }

    [[nodiscard]] double refracted_deg(double elevation_deg, double height_m) const {
        const render::sky::RefractionRow row =
            refraction_.at(height_m, air_.pressure_hpa, air_.temperature_c);
        return row.apparent_from_true(elevation_deg * kRadPerDeg) / kRadPerDeg;
    }

    AirSettings air_;
    render::sky::Refraction refraction_;
};

void require_readable(const CsvReader& reader, const std::string& name) {
    if (reader.failed())
        throw std::runtime_error(fmt::format("{}:{}: cannot be read", name, reader.line() + 1));
}

}  // namespace

BatchCount run_batch(std::istream& input, const OpenOutput& open_output, std::ostream& errors,
                     const BatchSettings& settings) {
    CsvReader reader(input);
    const std::optional<CsvRecord> heading = reader.next();
    require_readable(reader, settings.input_name);
    if (!heading) throw std::runtime_error(settings.input_name + ": no heading line");
    Columns columns;
    try {
        columns = read_heading(*heading, settings.time_column);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}:{}: {}", settings.input_name, heading->line, error.what()));
    }
    std::ostream& output = open_output();
    output << heading->text;
    for (const std::string_view name : kBatchColumns)
        output << ',' << name;
    output << heading->line_end;
    if (!columns.body && !settings.body)
        errors << settings.input_name << ": no column 'body': the Moon is told (--body names another)\n";

    const RowWriter writer(settings.air);
    BatchCount count;
    while (const std::optional<CsvRecord> record = reader.next()) {
        ++count.rows;
        try {
            const Row row(columns, *record);
            const std::optional<Geodetic> site = row.site(settings.site);
            const Body body = row.body(settings.body.value_or(Body::kMoon));
            const BodyPlace place =
                place_in(sky_of(row.instant(), site, settings.model), body, site.has_value());
            output << record->text << writer.columns_of(place, site) << record->line_end;
        } catch (const RowProblem& problem) {
            ++count.bad_rows;
            errors << settings.input_name << ':' << record->line << ": "
                   << (problem.column.empty() ? "" : problem.column + ": ") << problem.text << '\n';
            if (record->well_formed && record->fields.size() == columns.names.size())
                output << record->text << RowWriter::empty_columns() << record->line_end;
        }
    }
    require_readable(reader, settings.input_name);
    return count;
}

}  // namespace skyig::clients::ephem
