// Serves a session to pages: HTTP for the page itself, a WebSocket for the live link, on the loopback interface only.
//
// One thread, the one that calls `run`, does all networking. No page can block it: each has its own bounded queue, only the newest
// frame is kept, and a page that reads too slowly loses frames without affecting the others. Boost.Beast, which takes long to
// compile, is included by server.cpp only.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hamilcar/live/session.hpp"

namespace hamilcar::live {

struct ServerOptions {
    std::string page;                             // HTML
    std::uint16_t port = 0;                       // 0: any free port
    std::function<void(const std::string&)> log;  // receives a line every minute and at the end
};

class Server {
public:
    // Listens; throws io::Error(input_output) if the port is not available.
    Server(Session& session, ServerOptions options);
    ~Server();

    std::uint16_t port() const;
    std::string url() const;       // that opens the page, for as long as the server runs
    std::string url_once() const;  // likewise, for one visit

    // Serves until `stop` returns true, which is checked about twenty times a second; then closes all connections.
    void run(const std::function<bool()>& stop);

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace hamilcar::live
