// `hamilcar channels VEHICLE`: what a run can record of a vehicle.
#include "hamilcar/run/channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/io/json_text.hpp"

namespace hamilcar::cli {

namespace {

struct ChannelsOptions {
    VehicleChoice vehicle;
    bool json = false;
};

io::ExitCode channels(const ChannelsOptions& options) {
    const std::vector<Channel> all = all_channels(read_vehicle_or_shipped(options.vehicle));
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::size_t width = 0;
    for (const Channel& channel : all) width = std::max(width, channel.column.name.size());
    if (!options.json) fmt::print("Of the default set: *\n\n");
    for (const Channel& channel : all) {
        const io::Column& c = channel.column;
        list.push_back({{"name", c.name}, {"unit", c.unit}, {"meaning", c.description}, {"default", channel.standard}});
        if (!options.json) {
            fmt::print("{} {:<{}}  {:<8}{}\n", channel.standard ? '*' : ' ', c.name, width, c.unit, c.description);
        }
    }
    if (options.json) fmt::print("{}\n", io::json_text(list));
    return io::ExitCode::ok;
}

}  // namespace

void add_channels(CommandList& list) {
    auto [command, o] = list.add<ChannelsOptions>("channels", "list what a run can record of a vehicle", channels);
    command.add("vehicle", o.vehicle.file, "vehicle file (TOML) [the shipped 323i]");
    add_vehicle_set(command, o.vehicle);
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
