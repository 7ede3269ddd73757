// `hamilcar drive VEHICLE`: the full model at 1 kHz in real time, driven in the browser.
#include <fmt/format.h>

#include <filesystem>

#include "commands.hpp"
#include "garage.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/live/server.hpp"

namespace hamilcar::cli {

io::ExitCode drive(const Options& options) {
    const std::string vehicle = options.file.empty() ? shipped_file("vehicles/bmw_323i.toml") : options.file;
    io::read_vehicle(vehicle);  // a mistake in it is told before anything is opened
    double friction = 1;
    if (!options.scenario.empty()) friction = io::read_scenario(options.scenario).road.friction;
    live::Garage garage = make_garage(vehicle, options.scenario);
    const live::Wish first{.vehicle = choice_of(garage.vehicles, vehicle),
                           .road = options.scenario.empty() ? level_ground : choice_of(garage.roads, options.scenario),
                           .friction = friction};
    live::Session session(std::move(garage), first, options.output.empty() ? "out/drive" : options.output);
    live::Server server(session, {.page = std::string(io::page_template()),
                                  .port = static_cast<std::uint16_t>(options.port),
                                  .log = [](const std::string& line) { fmt::print(stderr, "hamilcar: {}\n", line); }});
    fmt::print("{}\n", server.url());
    std::fflush(stdout);
    fmt::print(stderr, "Drive in the browser under this address; Ctrl-C ends the drive.\n");
    if (!options.no_browser) open_in_browser(server.url());
    const InterruptWatch watch;
    server.run([] { return interrupted(); });
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
