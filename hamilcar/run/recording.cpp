#include "hamilcar/run/recording.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/replay_rows.hpp"

namespace hamilcar {

namespace {

std::vector<io::Column> columns_of(const std::vector<Channel>& channels) {
    std::vector<io::Column> out;
    for (const Channel& channel : channels) out.push_back(channel.column);
    return out;
}

}  // namespace

Recording::Recording(std::vector<io::Column> columns) : columns_(std::move(columns)), values_(columns_.size()) {}

Recording::Recording(const std::vector<Channel>& channels) : Recording(columns_of(channels)) {}

void Recording::add(double time, std::span<const double> row) {
    HAMILCAR_ASSERT(row.size() == values_.size());
    time_.push_back(time);
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i].push_back(row[i]);
}

void Recording::keep_rows(std::size_t count) {
    if (count >= size()) return;
    time_.resize(count);
    for (std::vector<double>& column : values_) column.resize(count);
}

double Recording::rate() const {
    return size() < 2 ? 1 : static_cast<double>(size() - 1) / (time_.back() - time_.front());
}

bool Recording::has(std::string_view channel) const {
    return std::ranges::find(columns_, channel, &io::Column::name) != columns_.end();
}

Series Recording::operator[](std::string_view channel) const {
    const auto column = std::ranges::find(columns_, channel, &io::Column::name);
    if (column == columns_.end()) throw std::out_of_range("channel not recorded: " + std::string(channel));
    return {values_[static_cast<std::size_t>(column - columns_.begin())], rate(), time_.empty() ? 0 : time_.front()};
}

io::PageRun page_run(const Recording& recording, const std::vector<Channel>& channels, std::string name,
                     std::string scene, double interval) {
    const auto every = static_cast<std::size_t>(std::max(1L, std::lround(interval * recording.rate())));
    const auto thinned = [&](std::span<const double> column) {
        std::vector<double> out;
        for (std::size_t i = 0; i < column.size(); i += every) out.push_back(column[i]);
        return out;
    };
    io::PageRun run;
    run.name = std::move(name), run.scene = std::move(scene);
    run.columns = {{"time", "s", "time since the start of the run"}};
    run.values = {thinned(recording.time())};
    for (const Channel& channel : channels) {
        run.columns.push_back(channel.column);
        run.values.push_back(thinned(recording[channel.column.name].values));
    }
    thin(run, default_page_rows);
    return run;
}

}  // namespace hamilcar
