#include "hamilcar/base/event_log.hpp"

#include <atomic>

namespace hamilcar {

namespace {

std::atomic<EventListener> listening{nullptr};

}  // namespace

void listen_to_events(EventListener listener) {
    listening = listener;
}

bool events_are_logged() {
    return listening != nullptr;
}

void log_event(const std::string& line) {
    if (const EventListener listener = listening) listener(line);
}

}  // namespace hamilcar
