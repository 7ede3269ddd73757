// The header of an OpenCRG file is read section by section into keys with their lines, before any sense is made of it:
// so the order of the sections is free, and every message names the line that it is about. Nothing is believed before it
// is checked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/io/crg_text.hpp"

namespace hamilcar::io::crg {

// What a number may be, far beyond any road but short of where arithmetic suffers.
constexpr double farthest = 1e8, highest = 1e5;         // [m]
constexpr double least_step = 1e-6, most_step = 1e4;    // [m]
constexpr double steepest = 1;                          // [1], as the format says
constexpr double most_turned = 1e4, sharpest_turn = 1;  // of a heading and between two [rad]

// The sections of keys.
inline const std::string road_section = "road_crg", options_section = "road_crg_opts",
                         modifiers_section = "road_crg_mods";

struct Entry {
    std::string value;
    int line = 0;
};

struct Channel {
    std::string name, unit;
    int line = 0;
};

class Header {
public:
    // Reads up to the line that ends the header. `name` stands for the file in messages.
    Header(Text& text, std::string name);

    // Throws Error(bad_file, "name:line: key KEY: expected EXPECTED").
    [[noreturn]] void fail(int line, const std::string& key, const std::string& expected) const;

    bool has_section(const std::string& section) const { return sections_.contains(section); }
    bool has(const std::string& section, const std::string& key) const;
    int line_of(const std::string& section, const std::string& key) const;
    double number(const std::string& section, const std::string& key, double fallback, double low, double high) const;
    std::optional<double> maybe(const std::string& section, const std::string& key, double most) const;
    int choice(const std::string& section, const std::string& key, int fallback, int most) const;

    // Of $KD_DEFINITION.
    const std::vector<Channel>& channels() const { return channels_; }
    const Entry& format() const { return format_; }
    const Entry& u_channel() const { return u_channel_; }
    int definition_line() const { return definition_line_; }

private:
    struct Section {
        std::map<std::string, Entry> keys;
        int line = 0;  // 0: not there
    };
    void read(Text& text);
    void open_section(std::string_view section, int at);
    void read_line_of(const std::string& section, std::string_view line, int at);
    void read_definition(std::string_view line, int at);
    void refuse_unknown() const;

    std::string name_;
    std::map<std::string, Section> sections_;
    std::vector<Channel> channels_;
    Entry format_, u_channel_;
    int definition_line_ = 0;
};

}  // namespace hamilcar::io::crg
