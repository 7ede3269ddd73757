#include "hamilcar/live/recording.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/run/film.hpp"

namespace hamilcar::live {

namespace {

constexpr std::size_t rows_in_ring = 2048;  // twenty seconds
constexpr auto poll_interval = std::chrono::milliseconds(50);
constexpr std::size_t position_columns = 3;  // of a row in the ring: time, x, y
constexpr int polls_per_flush = 20;          // a crash loses at most a second

std::vector<std::size_t> chosen_channels(const std::vector<Channel>& channels) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels[i].standard || channels[i].motion) chosen.push_back(i);
    }
    return chosen;
}

std::unique_ptr<io::ResultWriter> open(const std::string& path, const LiveSimulation& simulation,
                                       const std::vector<std::size_t>& chosen) {
    std::vector<io::Column> columns;
    for (const std::size_t i : chosen) columns.push_back(simulation.channels()[i].column);
    return io::open_netcdf(path, columns, simulation.vehicle().name, {{io::scene_attribute, simulation.scene()}});
}

// For use in a file name: letters, digits, '-' and '_'; other characters become '_'.
std::string sanitized(std::string name) {
    const auto is_allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    for (char& c : name) c = is_allowed(c) ? c : '_';
    return name;
}

}  // namespace

Recording::Recording(std::string path, std::shared_ptr<const LiveSimulation> simulation)
    : path_(std::move(path)),
      simulation_(std::move(simulation)),
      chosen_(chosen_channels(simulation_->channels())),
      writer_(open(path_, *simulation_, chosen_)),
      ring_(rows_in_ring, position_columns + chosen_.size()),
      thread_([this](const std::stop_token& stop) { write_rows(stop); }) {}

Recording::~Recording() {
    finish();
}

std::string Recording::finish() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    return failure_;
}

void Recording::add_row(double time, double x, double y, std::span<const double> values) {
    const std::span<double> row = ring_.free_row();
    if (row.empty()) {
        lost_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    row[0] = time, row[1] = x, row[2] = y;
    for (std::size_t i = 0; i < chosen_.size(); ++i) row[position_columns + i] = values[chosen_[i]];
    ring_.push();
}

void Recording::write_rows(const std::stop_token& stop) {
    try {
        for (int polls = 1; !stop.stop_requested(); ++polls) {
            std::this_thread::sleep_for(poll_interval);
            write_pending();
            if (polls % polls_per_flush == 0) writer_->flush();
        }
        write_pending();
        writer_->close();
        write_road();
    } catch (const std::exception& error) {  // a full disk: the file keeps what was flushed, further rows are lost
        failure_ = error.what();
        failed_.store(true, std::memory_order_release);
    }
}

void Recording::write_pending() {
    for (auto row = ring_.oldest(); !row.empty(); row = ring_.oldest()) {
        if (x_.empty()) first_time_ = row[0];
        x_.push_back(row[1]), y_.push_back(row[2]);
        writer_->write(row[0], row.subspan(position_columns));
        seconds_.store(row[0] - first_time_, std::memory_order_relaxed);
        ring_.pop();
    }
}

void Recording::write_road() const {
    if (!simulation_->uneven()) return;
    const auto tiles = tiles_along(simulation_->road(), simulation_->surface(), x_, y_);
    if (!tiles.empty()) io::write_tiles(io::tiles_beside(path_), tiles);
}

std::string new_recording_file(const std::string& folder, const std::string& name) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    const std::string stem = fmt::format("{}/{}-{:%Y%m%d-%H%M%S}", folder, sanitized(name), local);
    for (int copy = 1;; ++copy) {
        const std::string path = copy == 1 ? stem + ".nc" : fmt::format("{}-{}.nc", stem, copy);
        const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) {
            close(file);
            return path;
        }
        if (errno != EEXIST) {
            throw io::Error(io::ExitCode::input_output,
                            fmt::format("{}: cannot create: {}", path, std::strerror(errno)));
        }
    }
}

}  // namespace hamilcar::live
