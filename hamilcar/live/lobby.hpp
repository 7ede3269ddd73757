// Everybody who looks at the car, and the one who drives it; knows no sockets.
//
// The first page drives, the others watch. When the driver leaves, the car stands still until a page takes the wheel; a
// page that comes while nobody drives has it at once.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "hamilcar/live/messages.hpp"
#include "hamilcar/live/tiles.hpp"

namespace hamilcar::live {

// A connected page, as the lobby needs it. None of these waits, and none ends the page's stay before it has returned.
class Page {
public:
    virtual ~Page() = default;
    virtual void tell(Message text) = 0;   // in order; a page that lets too many pile up is let go
    virtual void show(Message frame) = 0;  // or a newer one
    virtual void give(Message tile) = 0;   // in order, as `tell`
    virtual bool has_room() const = 0;     // for a tile
    virtual long lost_frames() const = 0;
    virtual void turn_out(const char* reason) = 0;  // for not keeping to the protocol
};

class Lobby {
public:
    static constexpr int patience = 20;  // misunderstandings in a row

    explicit Lobby(Session& session) : session_(session) {}

    std::uint32_t enter(Page& page);  // gives the page its number
    void leave(std::uint32_t number);
    void hear(std::uint32_t number, std::string_view text);
    std::size_t size() const { return guests_.size(); }

    void attend();          // when the session's bell has rung
    void hand_out_tiles();  // a few; call it some twenty times a second
    void tell_status();
    std::string summary();  // one line for a log

private:
    struct Guest {
        Page* page;
        int misunderstandings = 0;
        std::set<TilePlace> tiles;  // that it has
    };
    void take_wheel(std::uint32_t number);
    void heed(std::uint32_t number, const ClientMessage& message);
    void wish(std::uint32_t number, const ClientMessage& message);
    void load(std::uint32_t number, const Wish& wish);
    void tell_result();
    void refuse(std::uint32_t number, std::string_view why);
    Message status_for(const Guest& guest);

    Session& session_;
    std::map<std::uint32_t, Guest> guests_;
    std::uint32_t last_number_ = 0, driver_ = 0;
    Message car_, frame_, result_;  // for a page that comes later
    Tiles tiles_;
};

}  // namespace hamilcar::live
