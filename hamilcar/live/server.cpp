#define BOOST_ASIO_DISABLE_THREADS  // one thread does all: no locks, and no fences, which ThreadSanitizer does not know

#include "hamilcar/live/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>

#include "hamilcar/io/error.hpp"
#include "hamilcar/live/server_door.hpp"

namespace hamilcar::live {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr int most_connections = 32;
constexpr int send_buffer = 1 << 17;  // small, so that frames get old here, where a newer one takes their place [byte]
constexpr auto tick_interval = std::chrono::milliseconds(50);
constexpr int ticks_per_status = 4, ticks_per_line = 1200;
constexpr auto leave_taking = std::chrono::seconds(1);

// What a child that is started, as a browser, does not inherit: one that outlives the server would keep its port.
void close_on_exec(int descriptor) {
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
}

tcp::acceptor listen(asio::io_context& context, std::uint16_t port) {
    try {
        tcp::acceptor acceptor(context, tcp::endpoint(asio::ip::address_v4::loopback(), port));
        close_on_exec(acceptor.native_handle());
        return acceptor;
    } catch (const boost::system::system_error& error) {
        throw io::Error(io::ExitCode::input_output,
                        fmt::format("cannot listen on 127.0.0.1:{}: {}", port, error.code().message()));
    }
}

}  // namespace

class Server::Parts {
public:
    Parts(Session& session, ServerOptions options)
        : options_(std::move(options)),
          lobby_(session),
          acceptor_(listen(context_, options_.port)),
          access_(random_token(), acceptor_.local_endpoint().port()),
          bell_(context_, ::fcntl(session.bell().descriptor(), F_DUPFD_CLOEXEC, 0)),
          tick_(context_) {}

    const Access& access() const { return access_; }
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

    void run(const std::function<bool()>& stop) {
        wait_for_visitors();
        wait_for_bell();
        tick_.expires_after(tick_interval);
        tick(stop);
        context_.run();
        context_.restart();
        context_.run_for(leave_taking);
        if (options_.log) options_.log(lobby_.summary());
    }

private:
    void wait_for_visitors() {
        waiting_ = true;
        acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
            waiting_ = false;
            if (error) return;  // too many open files, say: the next tick tries again
            if (house_.connections < most_connections) receive(std::move(socket));
            wait_for_visitors();
        });
    }

    void receive(tcp::socket socket) {
        close_on_exec(socket.native_handle());
        beast::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::send_buffer_size(send_buffer), ignored);
        std::make_shared<Visitor>(std::move(socket), house_, access_, options_.page)->welcome();
    }

    void wait_for_bell() {
        bell_.async_wait(asio::posix::stream_descriptor::wait_read, [this](beast::error_code error) {
            if (error) return;
            lobby_.attend();
            wait_for_bell();
        });
    }

    void tick(const std::function<bool()>& stop) {
        tick_.async_wait([this, &stop](beast::error_code) {
            if (stop()) return take_leave();
            ++ticks_;
            lobby_.hand_out_tiles();
            if (ticks_ % ticks_per_status == 0) lobby_.tell_status();
            if (ticks_ % ticks_per_line == 0 && options_.log) options_.log(lobby_.summary());
            if (!waiting_) wait_for_visitors();
            tick_.expires_after(tick_interval);
            tick(stop);
        });
    }

    void take_leave() {
        beast::error_code ignored;
        acceptor_.close(ignored);
        bell_.cancel(ignored);
        for (SocketPage* page : house_.pages) page->take_leave();
        context_.stop();
    }

    ServerOptions options_;
    Lobby lobby_;
    House house_{lobby_};
    asio::io_context context_{1};  // before it goes, it lets go of all connections
    tcp::acceptor acceptor_;
    Access access_;
    asio::posix::stream_descriptor bell_;
    asio::steady_timer tick_;
    bool waiting_ = false;
    long ticks_ = 0;
};

Server::Server(Session& session, ServerOptions options)
    : parts_(std::make_unique<Parts>(session, std::move(options))) {}

Server::~Server() = default;

std::uint16_t Server::port() const {
    return parts_->port();
}

const std::string& Server::token() const {
    return parts_->access().token();
}

std::string Server::url() const {
    return parts_->access().url();
}

void Server::run(const std::function<bool()>& stop) {
    parts_->run(stop);
}

}  // namespace hamilcar::live
