// What is driven, on its way to a netCDF file that hamilcar's other commands read.
//
// The thread that steps the car must never wait for a disk: it puts rows into a ring, and a thread of the recording's own
// takes them out and writes. Where the disk is too slow for long, rows are lost and counted.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hamilcar/io/results.hpp"
#include "hamilcar/live/ride.hpp"
#include "hamilcar/live/row_ring.hpp"

namespace hamilcar::live {

class Recording {
public:
    static constexpr double interval = 0.01;  // between rows, of simulated time [s]

    // Of the car's channels those of the default set and those that show motion. Throws io::Error(input_output).
    Recording(std::string path, std::shared_ptr<const Ride> ride);
    ~Recording();  // finishes
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    // For the thread that steps: where the car is and every channel's value.
    void put(double time, double x, double y, std::span<const double> values);

    // Writes what is still in the ring, and the road where it is uneven; nothing may be put any more. Says what went wrong.
    std::string finish();

    // For any thread.
    const std::string& path() const { return path_; }
    const Ride& ride() const { return *ride_; }
    double seconds() const { return seconds_.load(std::memory_order_relaxed); }  // of simulated time
    long lost_rows() const { return lost_.load(std::memory_order_relaxed); }
    bool failed() const { return failed_.load(std::memory_order_acquire); }
    const std::string& failure() const { return failure_; }  // once it has

private:
    void write_rows(const std::stop_token& stop);
    void write_what_is_there();
    void write_road() const;

    std::string path_;
    std::shared_ptr<const Ride> ride_;
    std::vector<std::size_t> chosen_;  // of the channels
    std::unique_ptr<io::ResultWriter> writer_;
    RowRing ring_;
    double first_ = 0;           // time of the first row [s]
    std::vector<double> x_, y_;  // where the car has been [m]
    std::atomic<double> seconds_{0};
    std::atomic<long> lost_{0};
    std::atomic<bool> failed_{false};
    std::string failure_;
    std::jthread thread_;
};

// A new empty file FOLDER/NAME-YYYYMMDD-HHMMSS.nc, or with -2, -3 and so on behind where there is one already; creates the
// folder. Throws io::Error(input_output).
std::string new_recording_file(const std::string& folder, const std::string& name);

}  // namespace hamilcar::live
