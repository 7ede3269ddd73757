// Who may come in. The server listens on this machine alone, but everything that runs here can reach it, and so can a foreign
// page in the person's own browser. So: a token that only the printed address has, a Host that is this machine's (a foreign
// name that resolves to it brings its own), and for the live link an Origin that is this server's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hamilcar::live {

// What is looked at of an HTTP request; a header that is absent or stands there twice is empty.
struct Request {
    std::string_view method, target, host, origin;
    bool upgrade = false;  // to a WebSocket
};

class Access {
public:
    Access(std::string token, std::uint16_t port);

    // The HTTP status of the answer: 200 sends the page, 101 opens the live link, anything else is a refusal.
    int judge(const Request& request) const;
    const std::string& token() const { return token_; }
    std::string url() const;  // of the page
    std::string content_security_policy() const;

private:
    bool is_host(std::string_view host) const;

    std::string token_;
    std::string address_, name_;  // "127.0.0.1:PORT", "localhost:PORT"
};

// What a refusal says to a person, who may have nothing but an old address: a line of text.
std::string refusal_text(int status, std::string_view reason);

// 128 random bits in hexadecimal. Throws io::Error(input_output) where the system has none.
std::string random_token();

// Whether two texts are equal, in a time that tells only how long `given` is.
bool same_secret(std::string_view given, std::string_view secret);

}  // namespace hamilcar::live
