#include "run_files.hpp"

#include <filesystem>

#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/run/scene.hpp"

namespace hamilcar::cli {

Recorded choose_channels(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    const std::vector<Channel> all = all_channels(vehicle);
    Recorded recorded{select_channels(all, scenario.output.channels, scenario.places), 0, {}};
    recorded.chosen = recorded.channels.size();
    if (!scenario.output.motion) return recorded;
    recorded.scene = scene_json(vehicle, scenario);
    add_missing_motion(all, recorded.channels);
    return recorded;
}

RunFiles::RunFiles(const std::string& folder, const ScenarioDescription& scenario, const Recorded& recorded,
                   Place place)
    : chosen_(recorded.chosen),
      netcdf_path_(folder + "/results.nc"),
      csv_path_(folder + "/results.csv"),
      beside_(place == Place::beside) {
    const auto name = [&](const std::string& path) {
        if (!beside_) return path;
        io::remove_left_beside(path);  // by a run that was killed; the folder is this one's
        beside_names_.list.push_back(io::create_beside(path));
        return beside_names_.list.back();
    };
    std::vector<io::Column> columns;
    for (const Channel& channel : recorded.channels) columns.push_back(channel.column);
    if (scenario.output.netcdf) {
        paths_.push_back(netcdf_path_);
        std::error_code nothing_there;
        if (!beside_) std::filesystem::remove(io::tiles_beside(netcdf_path_), nothing_there);  // of an earlier run
        std::vector<std::pair<std::string, std::string>> attributes;
        if (!recorded.scene.empty()) attributes.emplace_back(io::scene_attribute, recorded.scene);
        netcdf_ = io::open_netcdf(name(netcdf_path_), columns, scenario.name, attributes);
    }
    if (scenario.output.csv) {
        paths_.push_back(csv_path_);
        columns.resize(chosen_);
        csv_ = io::open_csv(name(csv_path_), columns);
    }
}

RunFiles::NamesBeside::~NamesBeside() {
    std::error_code nothing_there;  // once moved to their places
    for (const std::string& path : list) std::filesystem::remove(path, nothing_there);
}

void RunFiles::write(double time, std::span<const double> row) {
    if (netcdf_) netcdf_->write(time, row);
    if (csv_) csv_->write(time, row.first(chosen_));
    constexpr long rows_per_flush = 100;  // what a crash may cost
    if (++rows_ % rows_per_flush == 0) flush();
}

void RunFiles::flush() {
    if (netcdf_) netcdf_->flush();
    if (csv_) csv_->flush();
}

void RunFiles::take_place() {
    if (!beside_) return;
    flush();  // both, before either takes its place
    if (netcdf_) netcdf_->move_to(netcdf_path_);
    if (csv_) csv_->move_to(csv_path_);
    beside_ = false;
}

void RunFiles::close() {
    if (netcdf_) netcdf_->close();
    if (csv_) csv_->close();
}

void RunFiles::announce_road() {
    if (netcdf_) add(io::tiles_beside(netcdf_path_));
}

void RunFiles::write_road(const std::vector<RoadTile>& tiles) const {
    if (netcdf_ && !tiles.empty()) io::write_tiles(io::tiles_beside(netcdf_path_), tiles);
}

}  // namespace hamilcar::cli
