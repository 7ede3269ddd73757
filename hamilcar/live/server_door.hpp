// A connection that has yet to say what it wants: it gets the page, the live link, or a refusal. Only for server.cpp.
#pragma once

#include <optional>

#include "hamilcar/live/access.hpp"
#include "hamilcar/live/server_page.hpp"

namespace hamilcar::live {

class Visitor : public std::enable_shared_from_this<Visitor> {
public:
    static constexpr std::size_t most_pages = 16;

    Visitor(boost::asio::ip::tcp::socket socket, House& house, const Access& access, const std::string& page)
        : stream_(std::move(socket)), seat_(house), access_(access), page_(page) {}

    void welcome() {
        constexpr auto patience = std::chrono::seconds(2);
        constexpr std::uint32_t longest_header = 8192;
        parser_.header_limit(longest_header);
        stream_.expires_after(patience);
        beast::http::async_read_header(stream_, buffer_, parser_,
                                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                                           if (!error) self->answer();
                                       });
    }

private:
    using Response = beast::http::response<beast::http::string_body>;

    // Empty where it is absent or stands there more than once.
    std::string_view header(beast::http::field name) const {
        const auto [first, last] = parser_.get().equal_range(name);
        if (first == last || std::next(first) != last) return {};
        return {first->value().data(), first->value().size()};
    }

    void answer() {
        const Upgrade& request = parser_.get();
        const auto method = request.method_string(), target = request.target();
        const int status = access_.judge({.method = {method.data(), method.size()},
                                          .target = {target.data(), target.size()},
                                          .host = header(beast::http::field::host),
                                          .origin = header(beast::http::field::origin),
                                          .upgrade = beast::websocket::is_upgrade(request)});
        if (status != 101) return respond(static_cast<beast::http::status>(status));
        if (seat_.house().pages.size() >= most_pages) return respond(beast::http::status::service_unavailable);
        stream_.expires_never();  // the link has a clock of its own
        std::make_shared<SocketPage>(std::move(stream_), std::move(seat_))->accept(parser_.release());
    }

    void respond(beast::http::status status) {
        const bool found = status == beast::http::status::ok;
        response_ = Response(status, parser_.get().version());
        using beast::http::field;
        response_.set(field::content_type, found ? "text/html; charset=utf-8" : "text/plain; charset=utf-8");
        response_.set(field::cache_control, "no-store");
        response_.set("X-Content-Type-Options", "nosniff");
        response_.set("Referrer-Policy", "no-referrer");
        if (found) response_.set("Content-Security-Policy", access_.content_security_policy());
        response_.keep_alive(false);
        const auto reason = beast::http::obsolete_reason(status);
        const std::string text = refusal_text(static_cast<int>(status), {reason.data(), reason.size()});
        const std::string& body = found ? page_ : text;
        if (parser_.get().method() != beast::http::verb::head) response_.body() = body;
        response_.content_length(body.size());
        beast::http::async_write(stream_, response_,
                                 [self = shared_from_this()](beast::error_code, std::size_t) { self->part(); });
    }

    // The other side closes first, so that it has read everything.
    void part() {
        beast::error_code ignored;
        stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        stream_.async_read_some(boost::asio::buffer(rest_),
                                [self = shared_from_this()](beast::error_code error, std::size_t) {
                                    if (!error) self->part();
                                });
    }

    beast::tcp_stream stream_;
    Seat seat_;
    const Access& access_;
    const std::string& page_;
    beast::flat_buffer buffer_;
    beast::http::request_parser<beast::http::empty_body> parser_;
    Response response_;
    std::array<char, 1024> rest_{};
};

}  // namespace hamilcar::live
