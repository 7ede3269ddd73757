#include "hamilcar/live/recording.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/run/replay_rows.hpp"

namespace hamilcar::live {

namespace {

constexpr std::size_t rows_in_ring = 2048;  // twenty seconds
constexpr auto poll_interval = std::chrono::milliseconds(50);
constexpr std::size_t position_columns = 3;  // of a row in the ring: time, x, y
constexpr int polls_per_flush = 20;          // a crash loses at most a second

std::vector<std::size_t> chosen_channels(const std::vector<Channel>& channels) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (channels[i].standard || is_motion(channels[i].column.role)) chosen.push_back(i);
    }
    return chosen;
}

std::unique_ptr<io::ResultWriter> open(const std::string& path, const LiveSimulation& simulation,
                                       const std::vector<std::size_t>& chosen) {
    std::vector<io::Column> columns;
    for (const std::size_t i : chosen) columns.push_back(simulation.channels()[i].column);
    return io::open_netcdf(path, columns, simulation.vehicle().name, {{io::scene_attribute, simulation.scene()}});
}

struct Held {
    long files = 0;
    std::uintmax_t bytes = 0;
};

// Recordings and the roads beside them. What cannot be looked at counts as nothing.
Held held_by(const std::string& folder) {
    Held held;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const auto ending = entry->path().extension();
        if (ending != ".nc" && ending != ".road") continue;
        std::error_code ignored;
        const std::uintmax_t size = entry->file_size(ignored);
        held.bytes += ignored ? 0 : size;
        held.files += ending == ".nc";
    }
    return held;
}

std::uintmax_t room_beside(const std::string& path, const RecordingQuota& quota) {
    const std::uintmax_t held = held_by(std::filesystem::path(path).parent_path().string()).bytes;
    return quota.bytes - std::min(held, quota.bytes);
}

std::string full_text(const std::string& folder, const RecordingQuota& quota) {
    return fmt::format(
        "{}: holds as many recordings as it may, {} of them or {:.3g} GB; remove some, or start with another folder "
        "(-o)",
        folder, quota.files, 1e-9 * static_cast<double>(quota.bytes));
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

Recording::Recording(std::string path, std::shared_ptr<const LiveSimulation> simulation, const RecordingQuota& quota)
    : path_(std::move(path)),
      simulation_(std::move(simulation)),
      chosen_(chosen_channels(simulation_->channels())),
      quota_(quota),
      room_(room_beside(path_, quota)),
      row_bytes_((1 + chosen_.size()) * sizeof(double)),
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
        for (int polls = 1; !stop.stop_requested() && !is_full(); ++polls) {
            std::this_thread::sleep_for(poll_interval);
            write_pending();
            if (polls % polls_per_flush == 0) writer_->flush();
        }
        write_pending();
        writer_->close();
        write_road();
        if (!is_full()) return;
        failure_ = fmt::format("{}; {} is complete up to here",
                               full_text(std::filesystem::path(path_).parent_path().string(), quota_), path_);
        failed_.store(true, std::memory_order_release);
    } catch (const std::exception& error) {  // a full disk: the file keeps what was flushed, further rows are lost
        failure_ = error.what();
        failed_.store(true, std::memory_order_release);
    }
}

void Recording::write_pending() {
    for (auto row = ring_.oldest(); !row.empty() && !is_full(); row = ring_.oldest()) {
        if (x_.empty()) first_time_ = row[0];
        x_.push_back(row[1]), y_.push_back(row[2]);
        writer_->write(row[0], row.subspan(position_columns));
        ++rows_;
        seconds_.store(row[0] - first_time_, std::memory_order_relaxed);
        ring_.pop();
    }
}

void Recording::write_road() const {
    if (!simulation_->uneven()) return;
    const auto tiles = tiles_along(simulation_->road(), simulation_->surface(), x_, y_);
    if (!tiles.empty()) io::write_tiles(io::tiles_beside(path_), tiles);
}

std::string new_recording_file(const std::string& folder, const std::string& name, const RecordingQuota& quota) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    const Held held = held_by(folder);
    if (held.files >= quota.files || held.bytes >= quota.bytes) {
        throw io::Error(io::ExitCode::input_output, full_text(folder, quota));
    }
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
