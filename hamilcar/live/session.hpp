// A drive as the network side sees it: one car on one road that a thread steps, and whatever takes time done elsewhere.
//
// All of it is for one thread, which is never kept waiting. A new car is read and put on its road in the workshop while
// the old one goes on; if that fails the old one stays, and a notice says why.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/live/stepper.hpp"
#include "hamilcar/live/workshop.hpp"

namespace hamilcar::live {

struct Choice {
    std::string id;    // what a wish names
    std::string name;  // for people
};

// What can be driven, and where. `open` reads the files of a wish, of which it need not look at the friction; `course`, which
// may be left out, tells what that vehicle is to drive through on a road, where there is something. Both are called on any
// thread, by one at a time, and throw io::Error.
struct Garage {
    std::vector<Choice> vehicles, roads;
    std::function<std::pair<VehicleDescription, ScenarioDescription>(const Wish&)> open;
    std::function<std::optional<TestCourse>(const std::string& road, const VehicleDescription&)> course = {};
};

// Why a page's wish was not granted.
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
    // Reads the first car and puts it on its road; throws io::Error. Recordings go to a folder that is created for the first.
    Session(Garage garage, const Wish& first, std::string recordings_folder);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void hold(const Held& held) { stepper_.hold(held); }
    void reset();
    void pause(bool on);
    void set_driven(bool on);  // whether anybody is at the wheel: nobody at first
    void set_pace(double pace);
    // Both are granted later, or not, with a notice to the page. While a car is being made the last wish stands.
    void load(const Wish& wish, std::uint32_t page);
    void record(bool on, std::uint32_t page);

    const Garage& garage() const { return garage_; }
    Ride& ride() { return *ride_; }  // only what is for any thread, and frames
    const Progress& progress() { return stepper_.progress(); }
    RecordingStatus recording() const;
    // When the bell rings, silence it and call this: true if another car is on the road.
    bool attend();
    std::vector<Notice> take_notices() { return std::exchange(notices_, {}); }
    const Bell& bell() const { return bell_; }

private:
    // Does `job` in the workshop; what it returns is called by `attend`.
    void send_for(std::function<std::function<void()>()> job);
    std::shared_ptr<Ride> build(const Wish& wish, std::uint32_t number) const;
    void make_next();
    void settle_recording();
    void open_recording();
    void put_away(std::shared_ptr<void> thing);

    enum class Tape { none, opening, running, closing };

    Garage garage_;
    std::string folder_;
    Bell bell_;
    std::uint32_t cars_ = 1;  // ever asked for; the last one's number
    std::shared_ptr<Ride> ride_;
    std::optional<std::pair<Wish, std::uint32_t>> next_;  // to be made after the one at hand, and for which page
    bool making_ = false, changed_ = false;
    std::shared_ptr<Recording> recording_;
    Tape tape_ = Tape::none;
    bool recording_wanted_ = false;
    std::uint32_t recording_page_ = 0;  // that asked for it
    std::vector<Notice> notices_;
    std::mutex answers_mutex_;
    std::vector<std::function<void()>> answers_;
    Stepper stepper_;
    Workshop workshop_;
};

}  // namespace hamilcar::live
