// Access control. The server listens on the loopback interface only, but every local program can connect to it, and so can a
// foreign page in the user's own browser. A request therefore needs the token of the printed address, a Host header that names
// this machine (a foreign name that resolves to it sends its own) and, for the live link, the Origin of this server.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hamilcar::live {

// The parts of an HTTP request that access depends on. A header that is absent or repeated is empty.
struct HttpRequest {
    std::string_view method, target, host, origin;
    bool upgrade = false;  // to a WebSocket
};

class Access {
public:
    Access(std::string token, std::uint16_t port);

    // The HTTP status of the answer: 200 sends the page, 101 opens the live link, anything else is a refusal.
    int judge(const HttpRequest& request) const;
    const std::string& token() const { return token_; }
    std::string url() const;  // of the page
    std::string content_security_policy() const;

private:
    bool is_host(std::string_view host) const;

    std::string token_;
    std::string address_, name_;  // "127.0.0.1:PORT", "localhost:PORT"
};

// The one-line body of a refusal; the user may have an outdated address.
std::string refusal_text(int status, std::string_view reason);

// 128 random bits in hexadecimal. Throws io::Error(input_output) if the system provides none.
std::string random_token();

// Whether two strings are equal, in a time that depends only on the length of `given`.
bool same_secret(std::string_view given, std::string_view secret);

}  // namespace hamilcar::live
