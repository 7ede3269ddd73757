// What happens inside, line by line, for a listener that watches: files read, programs compiled. Without one nothing is composed.
#pragma once

#include <string>

namespace hamilcar {

// From here on every line goes there, from any thread; null: nowhere.
using EventListener = void (*)(const std::string& line);
void listen_to_events(EventListener listener);

// Whether a line is worth composing.
bool events_are_logged();
void log_event(const std::string& line);

}  // namespace hamilcar
