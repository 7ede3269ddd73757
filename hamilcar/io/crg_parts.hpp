// The parts of reading an OpenCRG file, in the order in which parse_crg uses them. Nothing is believed before it is checked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/description/crg.hpp"

namespace hamilcar::io::crg {

constexpr std::size_t record = 80;  // bytes or characters

// In lower case, with single blanks, without what a message could not show.
std::string plain(std::string_view text);

// What is left to be read.
class Text {
public:
    explicit Text(std::string_view bytes) : rest_(bytes) {}
    std::string_view rest() const { return rest_; }
    int line() const { return line_; }  // of the line last read
    std::string_view next_line();
    void skip(std::size_t bytes) { rest_.remove_prefix(bytes); }

private:
    std::string_view rest_;
    int line_ = 0;
};

// What a number may be, far beyond any road but short of where arithmetic suffers.
constexpr double max_distance = 1e8, max_height = 1e5;  // [m]
constexpr double min_step = 1e-6, max_step = 1e4;       // [m]
constexpr double max_slope = 1;                         // [1], as the format says
constexpr double max_heading = 1e4, max_turn = 1.57;    // of a heading and between two, less than a right angle [rad]

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

// Section by section the keys with their lines, before any sense is made of them: so the order of the sections is free, and
// every message names the line that it is about.
class Header {
public:
    // Reads up to the line that ends the header. `name` stands for the file in messages.
    Header(Text& text, std::string name);

    // Throws Error(bad_file, "name:line: key KEY: expected EXPECTED").
    [[noreturn]] void fail(int line, const std::string& key, const std::string& expected) const;
    // "name:line: key KEY TEXT", for what is read another way than it may be meant.
    std::string remark(int line, const std::string& key, const std::string& text) const;
    const std::vector<std::string>& remarks() const { return remarks_; }

    // Of $ROAD_CRG_FILE: the file that has the data, as it is written; empty without.
    const Entry& reference() const { return reference_; }

    bool has_section(const std::string& section) const { return sections_.contains(section); }
    bool has(const std::string& section, const std::string& key) const;
    int line_of(const std::string& section, const std::string& key) const;
    double number(const std::string& section, const std::string& key, double fallback, double low, double high) const;
    std::optional<double> maybe(const std::string& section, const std::string& key, double max) const;
    int choice(const std::string& section, const std::string& key, int fallback, int max) const;

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
    void list_unknown();

    std::string name_;
    std::map<std::string, Section> sections_;
    std::vector<Channel> channels_;
    Entry format_, u_channel_, reference_;
    int definition_line_ = 0;
    std::vector<std::string> remarks_;
};

// Which channel is what, and where the longitudinal sections lie.
struct Channels {
    std::optional<std::size_t> u, phi, slope, banking;  // of the reference line
    std::vector<std::size_t> sections;                  // from right to left ...
    std::vector<double> v;                              // ... at [m]
};

Channels find_channels(const Header& header, CrgDescription& road);

// The rows behind the header, in ASCII or binary, as many as the file has bytes for, whatever its header announces.
// Adds to `road` its heights, headings, slopes and bankings. Rows of padding at the end are left out.
void read_rows(Text& text, const Header& header, const Channels& channels, CrgDescription& road);

// What $ROAD_CRG_MODS of `header` asks for is done to the road as it was read, whose own header is `data`.
// In OpenCRG's order: what is scaled is scaled about the start of the line, then all is turned and moved.
void modify(const Header& header, const Header& data, CrgDescription& road);

}  // namespace hamilcar::io::crg
