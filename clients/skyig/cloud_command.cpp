#include "clients/skyig/cloud_command.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "clients/skyig/validators.h"
#include "render/cloud/slab_light.h"

namespace skyig::clients {

void add_cloud(CLI::App& app, CloudOptions& options) {
    CLI::App& verb = *app.add_subcommand("cloud", "light that a plane slab of cloud sends up and down");
    const std::vector<std::string> names(render::cloud::kSlabModelNames.begin(),
                                         render::cloud::kSlabModelNames.end());
    verb.add_option("--model", options.model, fmt::format("{} (table)", fmt::join(names, ", ")))
        ->check(CLI::IsMember(names))
        ->type_name("MODEL");
    CLI::App& what = *verb.add_option_group("what", "one of these");
    what.require_option(1);
    CLI::Option* cases =
        what.add_option("--cases", options.cases_path, "the table to fill in (CSV); - is standard input")
            ->type_name("FILE");
    verb.add_option("-o,--out", options.out_path,
                    "where the filled table goes; - is standard output (so it is)")
        ->type_name("FILE")
        ->needs(cases);
    CLI::Option* depth = what.add_option("--optical-depth", options.optical_depth, "of the slab, vertically")
                             ->check(finite_in(0.0, 1e6));
    verb.add_option("--asymmetry", options.g, "mean cosine of scattering (0.85)")
        ->check(finite_in(0.0, 0.95))
        ->needs(depth);
    verb.add_option("--albedo", options.albedo, "of one scattering (1)")
        ->check(finite_in(0.0, 1.0))
        ->needs(depth);
    verb.add_option("--sun-zenith", options.sun_zenith_deg, "degrees (0)")
        ->check(finite_in(0.0, 90.0))
        ->needs(depth);
    verb.add_option("--view-zenith", options.view_zenith_deg, "of the light's way up, or down, degrees (0)")
        ->check(finite_in(0.0, 90.0))
        ->needs(depth);
    verb.add_option("--rel-azimuth", options.rel_azimuth_deg,
                    "0 where light goes on as the Sun's does, 180 back to it, degrees (0)")
        ->check(finite_in(-1e6, 1e6))
        ->needs(depth);
    verb.add_flag("--json", options.json, "one case as JSON")->excludes(cases);
    verb.footer(
        "R_brf and T_brf are pi L / (mu0 F0) of the light that leaves the top and the base over black "
        "ground; "
        "R_flux, T_diffuse_flux and T_direct_flux parts of the flux mu0 F0 (the same for all models). A "
        "table "
        "has optical_depth, asymmetry_g, single_scattering_albedo, sun_zenith_deg (or diffuse), quantity "
        "(one "
        "of those), view_zenith_deg and rel_azimuth_deg; every row keeps its columns and gets skyig_value. A "
        "bad row is told on stderr, its value stays empty, and the exit status is 1.");
}

}  // namespace skyig::clients
