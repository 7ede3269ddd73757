// The thread that steps the car in real time and does nothing else.
//
// It sleeps until a step is due, fetches the controls, steps, and publishes a frame from time to time. It never waits for
// another thread: controls, frames and progress pass through `TripleBuffer`, recorded rows through a ring, and commands are
// guarded by a mutex that it only tries to lock before a step. Objects that it no longer needs are returned to the other
// thread, since destroying a car or closing a file takes time.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "hamilcar/live/live_simulation.hpp"
#include "hamilcar/live/pacer.hpp"
#include "hamilcar/live/recording.hpp"
#include "hamilcar/live/wake_up.hpp"

namespace hamilcar::live {

// Why the car does not move, by precedence.
enum class Pause { none, driver, no_driver, ended };

// Commands to the thread; of two of the same kind the later one wins.
struct Commands {
    std::shared_ptr<LiveSimulation> simulation;  // replaces the current one
    bool reset = false;                          // to the start; ends the recording, which covers one run
    std::optional<bool> pause;                   // the driver's
    std::optional<bool> driven;                  // a page has control
    std::optional<double> pace;
    std::optional<AidSet> aids_off;
    std::shared_ptr<Recording> recording;  // released if it belongs to another car
    bool stop_recording = false;
};

struct Progress {
    std::uint32_t car = 0;
    Pause paused = Pause::no_driver;
    std::string ended;  // reason, or ""
    double pace = 1;
    double time = 0;    // simulated [s]
    double step = 0;    // [s]
    PaceReport report;  // since the car was loaded
};

class Stepper {
public:
    // Signals `wake_up` on a new frame, progress or released object; starts paused, without a driver.
    Stepper(std::shared_ptr<LiveSimulation> simulation, const WakeUp& wake_up);

    // For one other thread.
    void set_controls(const ReceivedControls& received);
    template <class F>
    void post(F&& change) {
        const std::lock_guard lock(mutex_);
        change(commands_);
        has_commands_ = true;
    }
    std::vector<std::shared_ptr<void>> take_released();  // objects that the thread no longer needs
    const Progress& progress();

private:
    void run(const std::stop_token& stop);
    void apply_commands();
    void replace_simulation(std::shared_ptr<LiveSimulation> simulation);
    void restart();
    void release(std::shared_ptr<void> object);
    void step();
    void wait_idle();
    void report();
    Pause paused() const;

    const WakeUp& wake_up_;
    TripleBuffer<ReceivedControls> received_;
    TripleBuffer<Progress> progress_;
    std::mutex mutex_;
    Commands commands_;
    bool has_commands_ = false;
    std::vector<std::shared_ptr<void>> released_;

    std::shared_ptr<LiveSimulation> simulation_;
    std::shared_ptr<Recording> recording_;
    Pacer pacer_;
    bool paused_by_driver_ = false, driven_ = false;
    std::optional<End> end_;
    bool idle_ = true;
    Nanoseconds next_report_ = 0;
    std::jthread thread_;
};

}  // namespace hamilcar::live
