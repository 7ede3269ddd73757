// A live session as the network side sees it: one car on one road, stepped by its own thread; slow jobs run in the background.
//
// All methods are for one thread and never block it. A new car is read and initialized in the background while the old one keeps
// running; if that fails the old one stays, and a notice gives the reason.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hamilcar/live/background_worker.hpp"
#include "hamilcar/live/stepper.hpp"

namespace hamilcar::live {

struct Selectable {
    std::string id;       // named in a LoadRequest
    std::string name;     // shown to the user
    bool course = false;  // a road that is a maneuver's course
};

// The available vehicles and roads. `open` reads the files of a request and may ignore its friction; `course`, which is optional,
// returns the course of a road for that vehicle, if there is one. Both may be called on any thread, though never concurrently, and
// throw io::Error.
struct Catalog {
    std::vector<Selectable> vehicles, roads;
    std::function<std::pair<VehicleDescription, ScenarioDescription>(const LoadRequest&)> open;
    std::function<std::optional<TestCourse>(const std::string& road, const VehicleDescription&)> course = {};
};

// Why a page's request failed.
struct Notice {
    std::uint32_t page;
    std::string message;
};

struct RecordingStatus {
    std::string file;  // or ""
    double seconds = 0;
    long lost_rows = 0;
};

class Session {
public:
    // Reads and initializes the first car; throws io::Error. The recordings folder is created with the first recording.
    Session(Catalog catalog, const LoadRequest& first, std::string recordings_folder, const RecordingQuota& quota = {});
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void set_controls(const ReceivedControls& received) { stepper_.set_controls(received); }
    void reset();
    void pause(bool on);
    void set_driven(bool on);  // whether a page has control; initially none
    void set_pace(double pace);
    // False if the car has no such aid. What is off stays off when the car is reset; a new car has all on.
    bool switch_aid(std::string_view keyword, bool on);
    // Both are completed later; if one fails, the page gets a notice. While a car is being built, the last load request wins.
    void load(const LoadRequest& request, std::uint32_t page);
    void record(bool on, std::uint32_t page);

    const Catalog& catalog() const { return catalog_; }
    LiveSimulation& simulation() { return *simulation_; }  // only its constants and frames
    const Progress& progress() { return stepper_.progress(); }
    RecordingStatus recording() const;
    std::vector<std::string> switched_off() const;  // keywords of aids
    // To be called when the wake-up event is signaled, after clearing it. True if the car was replaced.
    bool update();
    std::vector<Notice> take_notices() { return std::exchange(notices_, {}); }
    const WakeUp& wake_up() const { return wake_up_; }

private:
    // Runs `job` on the background thread; the function that it returns is called by `update`.
    void run_in_background(std::function<std::function<void()>()> job);
    std::shared_ptr<LiveSimulation> build(const LoadRequest& request, std::uint32_t number) const;
    void build_next();
    void update_recording();
    void open_recording();
    void dispose_of(std::shared_ptr<void> object);

    enum class RecorderState { none, opening, running, closing };

    Catalog catalog_;
    std::string folder_;
    RecordingQuota quota_;
    WakeUp wake_up_;
    std::uint32_t cars_ = 1;  // requested so far; number of the last one
    std::shared_ptr<LiveSimulation> simulation_;
    AidSet aids_off_;  // of that car
    std::optional<std::pair<LoadRequest, std::uint32_t>>
        next_;  // to be built after the current one, and for which page
    bool building_ = false, changed_ = false;
    std::shared_ptr<Recording> recording_;
    RecorderState recorder_ = RecorderState::none;
    bool recording_wanted_ = false;
    std::uint32_t recording_page_ = 0;  // that requested it
    std::vector<Notice> notices_;
    std::mutex completions_mutex_;
    std::vector<std::function<void()>> completions_;
    Stepper stepper_;
    BackgroundWorker worker_;
};

}  // namespace hamilcar::live
