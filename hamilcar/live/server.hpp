// The door of a session for pages: HTTP for the page itself, a WebSocket for the live link, on this machine alone.
//
// One thread, the one that calls `run`, does all of the network. No page can hold it up: each has its own bounded queue, of
// frames only the newest waits, and whoever reads too slowly loses frames and disturbs nobody. Boost.Beast, which is long to
// compile, is included by server.cpp alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hamilcar/live/session.hpp"

namespace hamilcar::live {

struct ServerOptions {
    std::string page;                             // HTML
    std::uint16_t port = 0;                       // 0: any that is free
    std::function<void(const std::string&)> log;  // hears a line every minute and at the end
};

class Server {
public:
    // Listens; throws io::Error(input_output) where the port cannot be had.
    Server(Session& session, ServerOptions options);
    ~Server();

    std::uint16_t port() const;
    const std::string& token() const;
    std::string url() const;  // that opens the page

    // Serves until `stop` says so, which is asked some twenty times a second; pages are told that the server goes away.
    void run(const std::function<bool()>& stop);

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace hamilcar::live
