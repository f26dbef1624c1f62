#include "clients/skyig/sky_command.h"

#include "clients/skyig/validators.h"

namespace skyig::clients {

namespace {

CLI::Option* add_night(CLI::App& app, SkyOptions& options) {
    CLI::Option* night = app.add_flag("--night", options.night,
                                      "add what a dark sky has of its own, and the Moon if it is told");
    CLI::Option* utc = app.add_option("--utc", options.utc,
                                      "the real sky of that time, as 2026-06-21T19:30:00Z (the mean one)")
                           ->check(utc_time())
                           ->type_name("TIME")
                           ->needs(night);
    CLI::Option* latitude = app.add_option("--lat", options.latitude_deg, "its latitude, degrees north")
                                ->check(finite_in(-90.0, 90.0))
                                ->needs(utc);
    CLI::Option* longitude = app.add_option("--lon", options.longitude_deg, "its longitude, degrees east")
                                 ->check(finite_in(-360.0, 360.0))
                                 ->needs(utc);
    utc->needs(latitude)->needs(longitude);
    CLI::Option* phase = app.add_option("--moon-phase-angle", options.moon_phase_angle_deg,
                                        "degrees, 0 full .. 180 new (no Moon)")
                             ->check(finite_in(0.0, 180.0))
                             ->needs(night);
    CLI::Option* elevation =
        app.add_option("--moon-elevation", options.moon_elevation_deg, "degrees, airless")
            ->check(finite_in(-90.0, 90.0))
            ->needs(phase);
    CLI::Option* azimuth = app.add_option("--moon-rel-azimuth", options.moon_rel_azimuth_deg,
                                          "degrees from the Sun's azimuth (180)")
                               ->check(finite_in(-360.0, 360.0))
                               ->needs(phase);
    azimuth->needs(elevation);
    phase->needs(elevation);
    return night;
}

}  // namespace

void add_sky(CLI::App& app, SkyOptions& options) {
    CLI::Option* model =
        app.add_option("--model", options.model, "model of the day sky (the file's, or multi)")
            ->check(sky_model_name())
            ->type_name("MODEL");
    CLI::Option* truth =
        app.add_flag("--truth", options.truth, "the reference solver instead (some tenths of a second a row)")
            ->excludes(model);
    add_night(app, options)->excludes(truth);
    app.add_option("--atmosphere", options.atmosphere, "A, B (those of the truth tables) or a TOML file (B)")
        ->type_name("AIR");
    app.add_option("--cases", options.cases_path, "the table to fill in (CSV); - is standard input")
        ->required()
        ->type_name("FILE");
    app.add_option("-o,--out", options.out_path,
                   "where the filled table goes; - is standard output (so it is)")
        ->type_name("FILE");
    app.footer(
        "The table needs altitude_m (above the model's ground), sun_zenith_deg, view_zenith_deg and "
        "rel_azimuth_deg (from the Sun's); every row keeps its columns and gets skyig_Y_cd_m2, skyig_x, "
        "skyig_y (0, 0, 0 where it is black). Sun at 1 AU, no refraction. A TOML file holds [air], [sky] and "
        "[night] as in a configuration, or [planet] (docs/configuration.md). With --night airglow, zodiacal "
        "light and starlight are added, at their means or those of a real sky, which is turned so that its "
        "Sun "
        "stands at the rows' azimuth; the Moon is at its mean distance. A bad row is told on stderr, its new "
        "columns stay empty, and the exit status is 1.");
}

}  // namespace skyig::clients
