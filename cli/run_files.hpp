// The files that a run's rows go to while it lasts.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hamilcar/io/results.hpp"
#include "hamilcar/road/tile.hpp"
#include "hamilcar/run/channels.hpp"

namespace hamilcar::cli {

// What a run records: the channels that were chosen, then those that a picture of the vehicle needs besides.
struct Recorded {
    std::vector<Channel> channels;
    std::size_t chosen;
    std::string scene;  // empty where no picture is wanted
};

Recorded choose_channels(const VehicleDescription& vehicle, const ScenarioDescription& scenario);

// netCDF has all channels; tables for people have the chosen ones only.
class RunFiles {
    // Names that are not the files' own; what still has one goes away.
    struct NamesBeside {
        std::vector<std::string> list;
        ~NamesBeside();
    };

public:
    enum class Place {
        taken,   // at once: what an earlier run left is gone
        beside,  // names of their own until `take_place`, so that a run that is gone on with cannot lose its first part
    };

    // Throws io::Error(input_output), as all that writes.
    RunFiles(const std::string& folder, const ScenarioDescription& scenario, const Recorded& recorded, Place place);
    RunFiles(const RunFiles&) = delete;
    RunFiles& operator=(const RunFiles&) = delete;

    void write(double time, std::span<const double> row);
    void flush();
    void take_place();
    void close();
    // Tiles stand beside the netCDF file, whose picture needs them.
    void announce_road();
    void write_road(const std::vector<RoadTile>& tiles) const;
    void add(const std::string& path) { paths_.push_back(path); }
    const std::vector<std::string>& paths() const { return paths_; }

private:
    NamesBeside beside_names_;  // first: the files are closed before
    std::size_t chosen_;
    std::unique_ptr<io::ResultWriter> netcdf_, csv_;
    std::string netcdf_path_, csv_path_;
    std::vector<std::string> paths_;
    bool beside_;
    long rows_ = 0;
};

}  // namespace hamilcar::cli
