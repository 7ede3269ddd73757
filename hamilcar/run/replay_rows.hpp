// The rows of a run kept for a page, at most so many: a run that is longer keeps every second, fourth, ... row.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hamilcar/io/page.hpp"

namespace hamilcar {

struct Channel;

// 15 s at 1 ms, and what a page opens in a moment.
inline constexpr std::size_t default_page_rows = 20000;

class ReplayRows {
public:
    // `scene`: JSON, empty if only the plots are wanted.
    ReplayRows(std::string name, std::string scene, const std::vector<Channel>& channels,
               std::size_t most_rows = default_page_rows);
    void add(double time, std::span<const double> row);
    // The last row is always there. The replay is empty afterwards.
    io::PageRun take();

private:
    void keep(double time, std::span<const double> row);

    io::PageRun run_;
    std::size_t most_rows_, stride_ = 1, seen_ = 0;
    std::vector<double> last_;  // row with its time in front, where it was left out
};

// Of rows that were read back: the same thinning. Nothing happens to fewer.
void thin(io::PageRun& run, std::size_t most_rows);

// Leaves out the rows that follow another one by less than the interval [s], but for the last.
void keep_rows_apart(io::PageRun& run, double interval);

// The patches of an uneven road that a path of the chassis leads over, with what lies beside it; none on a plane.
std::vector<RoadTile> tiles_along(const PlaneRoad<double>& plane, const Surface* surface, std::span<const double> x,
                                  std::span<const double> y);

}  // namespace hamilcar
