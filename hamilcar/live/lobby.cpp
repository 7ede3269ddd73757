#include "hamilcar/live/lobby.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hamilcar::live {

namespace {

constexpr double sight = 48;      // how far around the car tiles are sent [m]
constexpr double memory = 96;     // beyond which a page may have dropped its own, and gets them anew [m]
constexpr int tiles_at_once = 4;  // that are made for one page

Message message(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
}

bool knows(const std::vector<Choice>& list, const std::string& id) {
    return std::any_of(list.begin(), list.end(), [&](const Choice& choice) { return choice.id == id; });
}

}  // namespace

std::uint32_t Lobby::enter(Page& page) {
    attend();
    const std::uint32_t number = ++last_number_;
    Guest& guest = guests_.emplace(number, Guest{&page}).first->second;
    page.tell(message(hello_message(number, session_.garage())));
    if (!car_) car_ = message(car_message(session_.ride()));
    page.tell(car_);
    if (driver_ == 0) take_wheel(number);
    page.tell(status_for(guest));
    if (frame_) page.show(frame_);
    if (result_) page.tell(result_);
    return number;
}

void Lobby::leave(std::uint32_t number) {
    guests_.erase(number);
    if (number != driver_) return;
    driver_ = 0;
    session_.set_driven(false);
    tell_status();
}

void Lobby::take_wheel(std::uint32_t number) {
    driver_ = number;
    session_.hold({.page = number});
    session_.set_driven(true);
}

void Lobby::hear(std::uint32_t number, std::string_view text) {
    Guest& guest = guests_.at(number);
    const auto heard = read_message(text);
    if (const auto* problem = std::get_if<Misunderstanding>(&heard)) {
        refuse(number, problem->message);
        if (++guest.misunderstandings == patience) guest.page->turn_out("too many messages that make no sense");
        return;
    }
    guest.misunderstandings = 0;
    heed(number, std::get<ClientMessage>(heard));
}

void Lobby::heed(std::uint32_t number, const ClientMessage& message) {
    if (const auto* input = std::get_if<InputMessage>(&message)) {
        if (number == driver_) session_.hold({number, input->sequence, input->controls});
    } else if (number == driver_) {
        wish(number, message);
    } else if (driver_ != 0) {
        refuse(number, fmt::format("Page {} drives, this one watches.", driver_));
    } else if (std::holds_alternative<TakeMessage>(message)) {
        take_wheel(number);
        tell_status();
    } else {
        refuse(number, "Nobody drives. Take the wheel first.");
    }
}

// The driver's, of which `take` is granted already.
void Lobby::wish(std::uint32_t number, const ClientMessage& message) {
    if (std::holds_alternative<ResetMessage>(message)) session_.reset();
    if (const auto* pause = std::get_if<PauseMessage>(&message)) session_.pause(pause->on);
    if (const auto* pace = std::get_if<PaceMessage>(&message)) session_.set_pace(pace->factor);
    if (const auto* record = std::get_if<RecordMessage>(&message)) session_.record(record->on, number);
    if (const auto* wanted = std::get_if<LoadMessage>(&message)) load(number, wanted->wish);
}

void Lobby::load(std::uint32_t number, const Wish& wish) {
    const Garage& garage = session_.garage();
    if (!knows(garage.vehicles, wish.vehicle)) {
        refuse(number, fmt::format("There is no vehicle '{}'.", wish.vehicle));
    } else if (!knows(garage.roads, wish.road)) {
        refuse(number, fmt::format("There is no road '{}'.", wish.road));
    } else {
        session_.load(wish, number);
    }
}

void Lobby::refuse(std::uint32_t number, std::string_view why) {
    const auto guest = guests_.find(number);
    if (guest != guests_.end()) guest->second.page->tell(message(refusal_message(why)));
}

void Lobby::attend() {
    session_.bell().silence();
    if (session_.attend()) {
        car_ = message(car_message(session_.ride()));
        frame_ = result_ = nullptr;
        tiles_.clear();
        for (auto& [number, guest] : guests_) {
            guest.tiles.clear();
            guest.page->tell(car_);
        }
    }
    for (const Notice& notice : session_.take_notices()) refuse(notice.page, notice.message);
    Ride& ride = session_.ride();
    if (!ride.frames().fetch()) return;
    frame_ = message(frame_message(ride.number(), ride.frames().value()));
    for (auto& [number, guest] : guests_) guest.page->show(frame_);
    tell_result();
}

// Once, and not again before the car has been back at its start.
void Lobby::tell_result() {
    Ride& ride = session_.ride();
    const CourseRun& run = ride.frames().value().run;
    if (!run.over) result_ = nullptr;
    if (!run.over || result_) return;
    result_ = message(result_message(*ride.course(), run));
    for (auto& [number, guest] : guests_) guest.page->tell(result_);
}

void Lobby::hand_out_tiles() {
    Ride& ride = session_.ride();
    if (!ride.uneven()) return;
    const Frame& frame = ride.frames().value();
    for (auto& [number, guest] : guests_) {
        std::erase_if(guest.tiles, [&](TilePlace place) { return tile_distance(frame.x, frame.y, place) > memory; });
    }
    const std::vector<TilePlace> places = tiles_near(frame.x, frame.y, sight);
    int made = 0;
    for (const TilePlace& place : places) {
        Message tile = tiles_.find(place);
        for (auto& [number, guest] : guests_) {
            if (guest.tiles.contains(place) || !guest.page->has_room()) continue;
            if (!tile && made++ == tiles_at_once) return;
            if (!tile) tile = tiles_.make(ride, place);
            guest.tiles.insert(place);
            guest.page->give(tile);
        }
    }
}

void Lobby::tell_status() {
    for (const auto& [number, guest] : guests_) guest.page->tell(status_for(guest));
}

Message Lobby::status_for(const Guest& guest) {
    return message(status_message({driver_, guests_.size()}, session_.progress(), session_.recording(),
                                  guest.page->lost_frames()));
}

std::string Lobby::summary() {
    const Progress& progress = session_.progress();
    const PaceReport& report = progress.report;
    std::string line =
        fmt::format("t = {:.1f} s, {} steps of {:.1f} us every {:.3f} ms, {} overruns, the worst {:.2f} ms, {} pages",
                    progress.time, report.steps, 1e6 * report.compute, 1e3 * report.period, report.overruns,
                    1e3 * report.worst, guests_.size());
    if (report.given_up > 0)
        line += fmt::format("; {} times late for long, {:.1f} s given up", report.given_up, report.lost);
    return line;
}

}  // namespace hamilcar::live
