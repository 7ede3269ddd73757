// The connected pages and the one that has control; independent of sockets.
//
// The first page drives, the others are viewers. When the driver disconnects, the car is paused until another page takes control;
// a page that connects while there is no driver gets control at once.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "hamilcar/live/messages.hpp"
#include "hamilcar/live/tiles.hpp"

namespace hamilcar::live {

// Interface of a connected page. No method blocks, and none removes the page before it returns.
class Page {
public:
    virtual ~Page() = default;
    virtual void send_text(Message text) = 0;    // in order; a page with too many pending messages is disconnected
    virtual void send_frame(Message frame) = 0;  // may be replaced by a newer one before it is sent
    virtual void send_tile(Message tile) = 0;    // in order, like `send_text`
    virtual bool has_room() const = 0;           // for another tile
    virtual long lost_frames() const = 0;
    virtual void disconnect(const char* reason) = 0;  // after a protocol violation
};

class Connections {
public:
    static constexpr int max_invalid_messages = 20;  // that are not forgiven yet

    explicit Connections(Session& session) : session_(session) {}

    std::uint32_t add(Page& page);  // returns the page's number
    void remove(std::uint32_t number);
    void receive(std::uint32_t number, std::string_view text);
    std::size_t size() const { return clients_.size(); }

    void update();      // when the session's wake-up event is signaled
    void send_tiles();  // a few; to be called about twenty times a second
    void send_status();
    void forgive();         // one invalid message of every page; to be called once a second
    std::string summary();  // one line for a log

private:
    struct Client {
        Page* page;
        int invalid_messages = 0;
        std::set<TileIndex> tiles;  // that were sent to it
    };
    void set_driver(std::uint32_t number);
    void handle(std::uint32_t number, const ClientMessage& message);
    void handle_driver_message(std::uint32_t number, const ClientMessage& message);
    void load(std::uint32_t number, const LoadRequest& request);
    void switch_aid(std::uint32_t number, const SwitchMessage& wanted);
    void send_result();
    void refuse(std::uint32_t number, std::string_view why);
    Message status_for(const Client& client);

    Session& session_;
    std::map<std::uint32_t, Client> clients_;
    std::uint32_t last_number_ = 0, driver_ = 0;
    Message car_, frame_, result_;  // for pages that connect later
    Tiles tiles_;
};

}  // namespace hamilcar::live
