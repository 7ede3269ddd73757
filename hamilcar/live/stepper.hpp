// The thread that steps the car in real time and does nothing else.
//
// It sleeps until a step is due, asks what the person holds, steps, and now and then shows a frame. It never waits for
// another thread: controls, frames and progress pass through `Newest`, rows through a ring, and orders lie in a box that it
// opens before a step if nobody else has it open. What it no longer needs it puts back there, since taking a car apart or
// closing a file takes time too.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "hamilcar/live/bell.hpp"
#include "hamilcar/live/pacer.hpp"
#include "hamilcar/live/recording.hpp"
#include "hamilcar/live/ride.hpp"

namespace hamilcar::live {

// Why the car does not move, by precedence.
enum class Pause { none, driver, nobody, ended };

// Wishes to the thread; of two of the same kind the later one holds.
struct Orders {
    std::shared_ptr<Ride> ride;  // in place of the present one
    bool reset = false;          // to the start; ends a recording, which is of one run
    std::optional<bool> pause;   // the driver's
    std::optional<bool> driven;  // somebody is at the wheel
    std::optional<double> pace;
    std::shared_ptr<Recording> recording;  // put back if it is of another car than the one that is driven
    bool stop_recording = false;
};

struct Progress {
    std::uint32_t car = 0;
    Pause paused = Pause::nobody;
    std::string ended;  // why
    double pace = 1;
    double time = 0;    // simulated [s]
    double step = 0;    // [s]
    PaceReport report;  // since the car was put on the road
};

class Stepper {
public:
    // Rings when there is a frame, progress or something put back; starts without anybody at the wheel.
    Stepper(std::shared_ptr<Ride> ride, const Bell& bell);

    // For one other thread.
    void hold(const Held& held);
    template <class F>
    void order(F&& change) {
        const std::lock_guard lock(box_);
        change(orders_);
        ordered_ = true;
    }
    std::vector<std::shared_ptr<void>> take_back();  // what the thread has done with
    const Progress& progress();

private:
    void run(const std::stop_token& stop);
    void heed_orders();
    void put_on_road(std::shared_ptr<Ride> ride);
    void start_anew();
    void put_back(std::shared_ptr<void> thing);
    void step();
    void rest();
    void report();
    Pause paused() const;

    const Bell& bell_;
    Newest<Held> held_;
    Newest<Progress> progress_;
    std::mutex box_;
    Orders orders_;
    bool ordered_ = false;
    std::vector<std::shared_ptr<void>> put_back_;

    std::shared_ptr<Ride> ride_;
    std::shared_ptr<Recording> recording_;
    Pacer pacer_;
    bool driver_pauses_ = false, driven_ = false;
    std::optional<End> end_;
    bool resting_ = true;
    Nanoseconds next_report_ = 0;
    std::jthread thread_;
};

}  // namespace hamilcar::live
