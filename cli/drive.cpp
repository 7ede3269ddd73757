// `hamilcar drive VEHICLE`: the full model at 1 kHz in real time, driven in the browser.
#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "browser.hpp"
#include "catalog.hpp"
#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/live/server.hpp"
#include "interrupt.hpp"

namespace hamilcar::cli {

namespace {

struct DriveOptions {
    VehicleChoice vehicle;
    std::string scenario, output = "out/drive";
    long port = 0;  // any
    bool no_browser = false;
};

io::ExitCode drive(const DriveOptions& options) {
    const VehicleChoice vehicle{vehicle_or_shipped(options.vehicle.file), options.vehicle.set};
    read_vehicle(vehicle);  // an error in it is reported before anything is opened
    double friction = 1;
    if (!options.scenario.empty()) friction = io::read_scenario(options.scenario).road.friction;
    live::Catalog catalog = make_catalog(vehicle, options.scenario);
    const live::LoadRequest first{
        .vehicle = choice_of(catalog.vehicles, vehicle.file),
        .road = options.scenario.empty() ? level_ground : choice_of(catalog.roads, options.scenario),
        .friction = friction};
    live::Session session(std::move(catalog), first, options.output);
    live::Server server(session, {.page = std::string(io::page_template()),
                                  .port = static_cast<std::uint16_t>(options.port),
                                  .log = [](const std::string& line) { fmt::print(stderr, "hamilcar: {}\n", line); }});
    fmt::print("{}\n", server.url());
    std::fflush(stdout);
    fmt::print(stderr, "Open this address in a browser to drive; press Ctrl-C to stop.\n");
    std::optional<SecretPage> page;
    if (!options.no_browser) page.emplace(options.output, server.url_once());
    const InterruptWatch watch;
    server.run([] { return interrupted(); });
    return io::ExitCode::ok;
}

}  // namespace

void add_drive(CommandList& list) {
    auto [command, o] =
        list.add<DriveOptions>("drive", "drive a vehicle in the browser: the full model in real time", drive);
    command.add("vehicle", o.vehicle.file, "vehicle file (TOML) [the shipped 323i]");
    add_vehicle_set(command, o.vehicle);
    command.add("--road", o.scenario, "scenario file (TOML) whose road and course to start on");
    command.add("--port", o.port, {0, 65535}, "on 127.0.0.1, any if 0");
    command.add("-o,--output", o.output, "folder for recordings");
    command.add("--no-browser", o.no_browser, "only print the address");
}

}  // namespace hamilcar::cli
