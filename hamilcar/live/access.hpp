// Access control. The server listens on the loopback interface only, but every local program can connect to it, and so can a
// foreign page in the user's own browser. A request therefore needs a Host header that names this machine (a foreign name that
// resolves to it sends its own), a secret and, for the live link, the Origin of this server.
//
// The printed address holds a token. It is that of an entrance, which gives the browser a cookie and sends it on to the page's
// own address, so that the browser neither shows nor remembers an address that opens anything. The browser that the program
// itself starts has a token of its own, which is good once. Browsers send a cookie to every port of a machine, but only below
// its path: the page is in a folder with a random name, so that no other server on this machine is sent it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hamilcar::live {

// The parts of an HTTP request that access depends on. A header that is absent or repeated is empty.
struct HttpRequest {
    std::string_view method, target, host, origin, cookie;
    bool upgrade = false;  // to a WebSocket
};

// Random and of no meaning.
struct Secrets {
    std::string token;    // of the printed address
    std::string once;     // of the address for the program's own browser
    std::string session;  // the cookie's value
    std::string folder;   // of the page and the link
};
// Throws io::Error(input_output) if the system provides no random numbers.
Secrets random_secrets();

class Access {
public:
    Access(Secrets secrets, std::uint16_t port);

    // The HTTP status of the answer: 200 sends the entrance or the page, 101 opens the live link, anything else is a refusal.
    int judge(const HttpRequest& request) const;
    static bool is_entrance(std::string_view target);
    void entered(std::string_view target);  // the token that is good once is so no longer

    std::string url() const;       // of the entrance, for as long as the program runs
    std::string url_once() const;  // likewise, for one visit
    std::string page_path() const { return "/" + secrets_.folder + "/"; }
    std::string cookie() const;         // as a Set-Cookie header
    std::string entrance_page() const;  // HTML
    // `inline_policy`: what the page says of its own scripts and styles.
    std::string content_security_policy(std::string_view inline_policy) const;

private:
    bool is_host(std::string_view host) const;
    bool opens(std::string_view token) const;

    Secrets secrets_;
    std::string address_, name_;  // "127.0.0.1:PORT", "localhost:PORT"
};

// What a page's own policy, a <meta> element in its head, allows of scripts and styles; nothing if it has none.
std::string inline_policy_of(std::string_view page);

// The one-line body of a refusal; the user may have an outdated address.
std::string refusal_text(int status, std::string_view reason);

// 128 random bits in hexadecimal. Throws io::Error(input_output) if the system provides none.
std::string random_token();

// Whether two strings are equal, in a time that depends only on the length of `given`. Nothing is equal to an empty secret.
bool same_secret(std::string_view given, std::string_view secret);

}  // namespace hamilcar::live
