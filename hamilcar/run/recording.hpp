// What a run recorded: channels by their names, a column each, row by row at a steady rate.
//
//     Simulation ─► Sample ─► Channel::read ─► Recording ─► Series ─► figures, diagrams, replay
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/io/page.hpp"

namespace hamilcar {

struct Channel;

class Recording {
public:
    Recording() = default;
    explicit Recording(std::vector<io::Column> columns);
    explicit Recording(const std::vector<Channel>& channels);

    void add(double time, std::span<const double> row);
    void keep_rows(std::size_t count);  // the first ones

    std::size_t size() const { return time_.size(); }
    const std::vector<double>& time() const { return time_; }  // [s]
    double end() const { return time_.back(); }                // [s]
    double rate() const;                                       // of the rows [Hz]; 1 of a single row
    bool has(std::string_view channel) const;
    // In the channel's unit. std::out_of_range for a channel that was not recorded.
    Series operator[](std::string_view channel) const;

private:
    std::vector<io::Column> columns_;
    std::vector<double> time_;
    std::vector<std::vector<double>> values_;
};

// The rows for a page's replay and plots: those channels, no more rows than a page has, and at least `interval` [s] apart.
io::PageRun page_run(const Recording& recording, const std::vector<Channel>& channels, std::string name,
                     std::string scene, double interval = 0);

}  // namespace hamilcar
