// A new connection: reads an HTTP request and answers with the page, the live link or a refusal. Only for server.cpp.
#pragma once

#include <optional>

#include "hamilcar/live/access.hpp"
#include "hamilcar/live/socket_page.hpp"

namespace hamilcar::live {

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
public:
    static constexpr std::size_t max_pages = 16;

    HttpConnection(boost::asio::ip::tcp::socket socket, ServerState& state, const Access& access,
                   const std::string& page)
        : stream_(std::move(socket)), slot_(state), access_(access), page_(page) {}

    void start() {
        constexpr auto header_timeout = std::chrono::seconds(2);
        constexpr std::uint32_t max_header_size = 8192;
        parser_.header_limit(max_header_size);
        stream_.expires_after(header_timeout);
        beast::http::async_read_header(stream_, buffer_, parser_,
                                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                                           if (!error) self->answer();
                                       });
    }

private:
    using Response = beast::http::response<beast::http::string_body>;

    // Empty if it is absent or repeated.
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
        if (slot_.state().pages.size() >= max_pages) return respond(beast::http::status::service_unavailable);
        stream_.expires_never();  // the link has its own timeouts
        std::make_shared<SocketPage>(std::move(stream_), std::move(slot_))->accept(parser_.release());
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
                                 [self = shared_from_this()](beast::error_code, std::size_t) { self->shut_down(); });
    }

    // The client closes first, so that it has received everything.
    void shut_down() {
        beast::error_code ignored;
        stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        stream_.async_read_some(boost::asio::buffer(rest_),
                                [self = shared_from_this()](beast::error_code error, std::size_t) {
                                    if (!error) self->shut_down();
                                });
    }

    beast::tcp_stream stream_;
    Slot slot_;
    const Access& access_;
    const std::string& page_;
    beast::flat_buffer buffer_;
    beast::http::request_parser<beast::http::empty_body> parser_;
    Response response_;
    std::array<char, 1024> rest_{};
};

}  // namespace hamilcar::live
