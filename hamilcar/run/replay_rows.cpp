#include "hamilcar/run/replay_rows.hpp"

#include <set>

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

namespace {

constexpr double beside = 10;               // of the path that is shown [m]
constexpr std::size_t most_tiles = 600;     // of one run; a longer road is shown as far as they reach
constexpr std::size_t rows_of_a_block = 2;  // out of which one is kept when there are too many

// Every second row, the first among them.
void halve(std::vector<double>& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); i += rows_of_a_block) values[kept++] = values[i];
    values.resize(kept);
}

}  // namespace

ReplayRows::ReplayRows(std::string name, std::string scene, const std::vector<Channel>& channels, std::size_t most_rows)
    : most_rows_(most_rows) {
    run_.name = std::move(name), run_.scene = std::move(scene);
    run_.columns = {{"time", "s", "time since the start of the run"}};
    for (const Channel& channel : channels) run_.columns.push_back(channel.column);
    run_.values.resize(run_.columns.size());
}

void ReplayRows::keep(double time, std::span<const double> row) {
    run_.values[0].push_back(time);
    for (std::size_t i = 0; i < row.size(); ++i) run_.values[i + 1].push_back(row[i]);
}

void ReplayRows::add(double time, std::span<const double> row) {
    const auto leave_out = [&] {
        last_.assign(1, time);
        last_.insert(last_.end(), row.begin(), row.end());
    };
    if (seen_++ % stride_ != 0) return leave_out();
    last_.clear();
    keep(time, row);
    if (run_.values[0].size() <= most_rows_) return;
    if ((run_.values[0].size() - 1) % rows_of_a_block != 0) leave_out();  // this row itself is one of those that go
    for (std::vector<double>& values : run_.values) halve(values);
    stride_ *= rows_of_a_block;
}

io::PageRun ReplayRows::take() {
    if (!last_.empty()) keep(last_[0], std::span(last_).subspan(1));
    return std::move(run_);
}

void thin(io::PageRun& run, std::size_t most_rows) {
    while (run.values[0].size() > most_rows) {
        for (std::vector<double>& values : run.values) {
            const double last = values.back();
            const bool lost = (values.size() - 1) % rows_of_a_block != 0;
            halve(values);
            if (lost) values.push_back(last);
        }
    }
}

void keep_rows_apart(io::PageRun& run, double interval) {
    const std::vector<double> time = run.values[0];
    const double slack = 1e-9 * interval;  // of times that are sums of steps
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (kept.empty() || i + 1 == time.size() || time[i] - time[kept.back()] >= interval - slack) kept.push_back(i);
    }
    for (std::vector<double>& values : run.values) {
        for (std::size_t n = 0; n < kept.size(); ++n) values[n] = values[kept[n]];
        values.resize(kept.size());
    }
}

std::vector<RoadTile> tiles_along(const PlaneRoad<double>& plane, const Surface* surface, std::span<const double> x,
                                  std::span<const double> y) {
    std::vector<RoadTile> tiles;
    if (!surface) return tiles;
    std::set<std::pair<int, int>> known;
    for (std::size_t i = 0; i < x.size(); ++i) {
        for (int ix = tile_at(x[i] - beside); ix <= tile_at(x[i] + beside); ++ix) {
            for (int iy = tile_at(y[i] - beside); iy <= tile_at(y[i] + beside); ++iy) {
                if (tiles.size() >= most_tiles || !known.emplace(ix, iy).second) continue;
                tiles.push_back(road_tile(plane, surface, ix, iy));
            }
        }
    }
    return tiles;
}

}  // namespace hamilcar
