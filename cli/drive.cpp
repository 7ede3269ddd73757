// `hamilcar drive VEHICLE`: the full model at 1 kHz in real time, driven in the browser.
#include <fmt/format.h>

#include <filesystem>

#include "catalog.hpp"
#include "commands.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/live/server.hpp"

namespace hamilcar::cli {

io::ExitCode drive(const Options& options) {
    const std::string vehicle = options.file.empty() ? shipped_file("vehicles/bmw_323i.toml") : options.file;
    io::read_vehicle(vehicle);  // an error in it is reported before anything is opened
    double friction = 1;
    if (!options.scenario.empty()) friction = io::read_scenario(options.scenario).road.friction;
    live::Catalog catalog = make_catalog(vehicle, options.scenario);
    const live::LoadRequest first{
        .vehicle = choice_of(catalog.vehicles, vehicle),
        .road = options.scenario.empty() ? level_ground : choice_of(catalog.roads, options.scenario),
        .friction = friction};
    live::Session session(std::move(catalog), first, options.output.empty() ? "out/drive" : options.output);
    live::Server server(session, {.page = std::string(io::page_template()),
                                  .port = static_cast<std::uint16_t>(options.port),
                                  .log = [](const std::string& line) { fmt::print(stderr, "hamilcar: {}\n", line); }});
    fmt::print("{}\n", server.url());
    std::fflush(stdout);
    fmt::print(stderr, "Open this address in a browser to drive; press Ctrl-C to stop.\n");
    if (!options.no_browser) open_in_browser(server.url());
    const InterruptWatch watch;
    server.run([] { return interrupted(); });
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
