// Records a drive in a netCDF file that hamilcar's other commands read.
//
// The thread that steps the car must never wait for a disk: it puts rows into a ring, and the recording's own thread writes them.
// If the disk is too slow for long, rows are lost and counted.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hamilcar/io/results.hpp"
#include "hamilcar/live/live_simulation.hpp"
#include "hamilcar/live/row_ring.hpp"

namespace hamilcar::live {

// What a folder of recordings may hold, those of earlier drives included; a page that records on and on fills no disk.
struct RecordingQuota {
    long files = 500;
    std::uintmax_t bytes = 4'000'000'000;  // about ten hours
};

class Recording {
public:
    static constexpr double interval = 0.01;  // between rows, of simulated time [s]

    // Records the channels of the default set and those that show motion, until the folder holds as much as it may; then it
    // fails with what is written complete. Throws io::Error(input_output).
    Recording(std::string path, std::shared_ptr<const LiveSimulation> simulation, const RecordingQuota& quota = {});
    ~Recording();  // calls `finish`
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    // For the thread that steps: position of the car and values of all channels.
    void add_row(double time, double x, double y, std::span<const double> values);

    // Writes the remaining rows and an uneven road; no row may be added afterwards. Returns the error message, or "".
    std::string finish();

    // For any thread.
    const std::string& path() const { return path_; }
    const LiveSimulation& simulation() const { return *simulation_; }
    double seconds() const { return seconds_.load(std::memory_order_relaxed); }  // of simulated time
    long lost_rows() const { return lost_.load(std::memory_order_relaxed); }
    bool failed() const { return failed_.load(std::memory_order_acquire); }

private:
    void write_rows(const std::stop_token& stop);
    void write_pending();
    void write_road() const;
    bool is_full() const { return (rows_ + 1) * row_bytes_ > room_; }

    std::string path_;
    std::shared_ptr<const LiveSimulation> simulation_;
    std::vector<std::size_t> chosen_;  // indices of the recorded channels
    RecordingQuota quota_;
    std::uintmax_t room_, row_bytes_, rows_ = 0;  // of the folder for rows, of one [byte]; those written
    std::unique_ptr<io::ResultWriter> writer_;
    RowRing ring_;
    double first_time_ = 0;      // time of the first row [s]
    std::vector<double> x_, y_;  // path of the car [m]
    std::atomic<double> seconds_{0};
    std::atomic<long> lost_{0};
    std::atomic<bool> failed_{false};
    std::string failure_;
    std::jthread thread_;
};

// Creates an empty file FOLDER/NAME-YYYYMMDD-HHMMSS.nc, with a suffix -2, -3 and so on if that exists, and the folder. Throws
// io::Error(input_output), also if the folder holds as much as it may.
std::string new_recording_file(const std::string& folder, const std::string& name, const RecordingQuota& quota = {});

}  // namespace hamilcar::live
