#include "hamilcar/live/connections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hamilcar::live {

namespace {

constexpr double tile_radius = 48;       // around the car, within which tiles are sent [m]
constexpr double page_tile_radius = 96;  // beyond which a page may have dropped a tile and is sent it again [m]
constexpr int max_new_tiles = 4;         // computed in one call

Message message(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
}

bool contains_id(const std::vector<Selectable>& list, const std::string& id) {
    return std::any_of(list.begin(), list.end(), [&](const Selectable& choice) { return choice.id == id; });
}

}  // namespace

std::uint32_t Connections::add(Page& page) {
    update();
    const std::uint32_t number = ++last_number_;
    Client& client = clients_.emplace(number, Client{&page}).first->second;
    page.send_text(message(hello_message(number, session_.catalog())));
    if (!car_) car_ = message(car_message(session_.simulation()));
    page.send_text(car_);
    if (driver_ == 0) set_driver(number);
    page.send_text(status_for(client));
    if (frame_) page.send_frame(frame_);
    if (result_) page.send_text(result_);
    return number;
}

void Connections::remove(std::uint32_t number) {
    clients_.erase(number);
    if (number != driver_) return;
    driver_ = 0;
    session_.set_driven(false);
    send_status();
}

void Connections::set_driver(std::uint32_t number) {
    driver_ = number;
    session_.set_controls({.page = number});
    session_.set_driven(true);
}

void Connections::receive(std::uint32_t number, std::string_view text) {
    Client& client = clients_.at(number);
    const auto parsed = read_message(text);
    if (const auto* problem = std::get_if<InvalidMessage>(&parsed)) {
        refuse(number, problem->message);
        if (++client.invalid_messages >= max_invalid_messages) client.page->disconnect("too many invalid messages");
        return;
    }
    handle(number, std::get<ClientMessage>(parsed));
}

void Connections::handle(std::uint32_t number, const ClientMessage& message) {
    if (const auto* input = std::get_if<InputMessage>(&message)) {
        if (number == driver_) session_.set_controls({number, input->sequence, input->controls});
    } else if (number == driver_) {
        handle_driver_message(number, message);
    } else if (driver_ != 0) {
        refuse(number, fmt::format("Page {} has control; this page is a viewer.", driver_));
    } else if (std::holds_alternative<TakeMessage>(message)) {
        set_driver(number);
        send_status();
    } else {
        refuse(number, "No page has control. Take the wheel first.");
    }
}

// Messages of the driver; `take` needs no action, it has control already.
void Connections::handle_driver_message(std::uint32_t number, const ClientMessage& message) {
    if (std::holds_alternative<ResetMessage>(message)) session_.reset();
    if (const auto* pause = std::get_if<PauseMessage>(&message)) session_.pause(pause->on);
    if (const auto* pace = std::get_if<PaceMessage>(&message)) session_.set_pace(pace->factor);
    if (const auto* record = std::get_if<RecordMessage>(&message)) session_.record(record->on, number);
    if (const auto* to_switch = std::get_if<SwitchMessage>(&message)) switch_aid(number, *to_switch);
    if (const auto* to_load = std::get_if<LoadMessage>(&message)) load(number, to_load->request);
}

void Connections::load(std::uint32_t number, const LoadRequest& request) {
    const Catalog& catalog = session_.catalog();
    if (!contains_id(catalog.vehicles, request.vehicle)) {
        refuse(number, fmt::format("There is no vehicle '{}'.", request.vehicle));
    } else if (!contains_id(catalog.roads, request.road)) {
        refuse(number, fmt::format("There is no road '{}'.", request.road));
    } else {
        session_.load(request, number);
    }
}

void Connections::switch_aid(std::uint32_t number, const SwitchMessage& wanted) {
    if (!session_.switch_aid(wanted.aid, wanted.on)) refuse(number, fmt::format("This car has no '{}'.", wanted.aid));
}

void Connections::refuse(std::uint32_t number, std::string_view why) {
    const auto client = clients_.find(number);
    if (client != clients_.end()) client->second.page->send_text(message(refusal_message(why)));
}

void Connections::update() {
    session_.wake_up().clear();
    if (session_.update()) {
        car_ = message(car_message(session_.simulation()));
        frame_ = result_ = nullptr;
        tiles_.clear();
        for (auto& [number, client] : clients_) {
            client.tiles.clear();
            client.page->send_text(car_);
        }
    }
    for (const Notice& notice : session_.take_notices()) refuse(notice.page, notice.message);
    LiveSimulation& simulation = session_.simulation();
    if (!simulation.frames().fetch()) return;
    frame_ = message(frame_message(simulation.number(), simulation.frames().value()));
    for (auto& [number, client] : clients_) client.page->send_frame(frame_);
    send_result();
}

// Once per run: not again before the car has returned to its start.
void Connections::send_result() {
    LiveSimulation& simulation = session_.simulation();
    const CourseRun& run = simulation.frames().value().run;
    if (!run.over) result_ = nullptr;
    if (!run.over || result_) return;
    result_ = message(result_message(*simulation.course(), run));
    for (auto& [number, client] : clients_) client.page->send_text(result_);
}

void Connections::send_tiles() {
    LiveSimulation& simulation = session_.simulation();
    if (!simulation.uneven()) return;
    const Frame& frame = simulation.frames().value();
    for (auto& [number, client] : clients_) {
        std::erase_if(client.tiles,
                      [&](TileIndex index) { return tile_distance(frame.x, frame.y, index) > page_tile_radius; });
    }
    const std::vector<TileIndex> indices = tiles_near(frame.x, frame.y, tile_radius);
    int made = 0;
    for (const TileIndex& index : indices) {
        Message tile = tiles_.find(index);
        for (auto& [number, client] : clients_) {
            if (client.tiles.contains(index) || !client.page->has_room()) continue;
            if (!tile && made++ == max_new_tiles) return;
            if (!tile) tile = tiles_.make(simulation, index);
            client.tiles.insert(index);
            client.page->send_tile(tile);
        }
    }
}

void Connections::send_status() {
    for (const auto& [number, client] : clients_) client.page->send_text(status_for(client));
}

void Connections::forgive() {
    for (auto& [number, client] : clients_) client.invalid_messages = std::max(client.invalid_messages - 1, 0);
}

Message Connections::status_for(const Client& client) {
    return message(status_message({driver_, clients_.size()}, session_.progress(), session_.recording(),
                                  session_.switched_off(), client.page->lost_frames()));
}

std::string Connections::summary() {
    const Progress& progress = session_.progress();
    const PaceReport& report = progress.report;
    std::string line = fmt::format(
        "t = {:.1f} s, {} steps of {:.1f} us every {:.3f} ms, {} overruns, largest delay {:.2f} ms, {} pages",
        progress.time, report.steps, 1e6 * report.compute, 1e3 * report.period, report.overruns,
        1e3 * report.worst_delay, clients_.size());
    if (report.skips > 0)
        line += fmt::format("; fell behind {} times, {:.1f} s skipped", report.skips, report.skipped_time);
    return line;
}

}  // namespace hamilcar::live
