// SPDX-License-Identifier: GPL-3.0-or-later
// The transport of MPI conforms: mpirun -n N test_mpi. `test_mpi large` gathers and sends more
// bytes than an int counts, in 5 GB of each process; ctest leaves that out.
#include <iostream>
#include <string_view>
#include <thread>

#include "conformance.hpp"
#include "mpi/mpi.hpp"

using namespace salebra;
using namespace salebra::testing;

namespace {

// A group of processes in another order than that of all.
void check_group(const Communicator& all) {
  MPI_Comm group = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, all.rank() % 2, -all.rank(), &group);
  {
    const Communicator ranks = mpi::communicator(group);
    expect(ranks.size() == (all.size() + 1 - all.rank() % 2) / 2, "group: of another size");
    expect(ranks.rank() == (all.size() - 1 - all.rank()) / 2, "group: in another order");
    check_conformance(ranks);
  }
  MPI_Comm_free(&group);
}

// The caller's own messages stay apart from those of a communicator.
void check_own_messages() {
  const Communicator ranks = mpi::communicator(MPI_COMM_WORLD);
  const int next = (ranks.rank() + 1) % ranks.size();
  int mine = ranks.rank(), other = -1;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Irecv(&other, 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &request);
  check_exchange(ranks);
  MPI_Send(&mine, 1, MPI_INT, next, 0, MPI_COMM_WORLD);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  expect(other == (ranks.rank() + ranks.size() - 1) % ranks.size(), "message: of another");
}

void check_refusals(const Communicator& ranks) {
  const auto refused = [](const auto& call) {
    try {
      call();
    } catch (const InvalidInput&) {
      return true;
    }
    return false;
  };
  // Nothing is sent: each process refuses before it calls MPI.
  const auto count = static_cast<std::size_t>(ranks.size());
  const Exchange huge_unit(std::size_t{1} << 31, std::vector<std::int64_t>(count, 0),
                           std::vector<std::int64_t>(count, 0));
  expect(ranks.alone() || refused([&] { ranks.exchange(huge_unit, nullptr, nullptr); }),
         "exchange: a unit that is too large");
}

// Equal parts of 'a', 'b', …, one from each process.
bool is_by_ranks(std::string_view text, std::size_t ranks) {
  const std::size_t each = text.size() / ranks;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    if (text.substr(rank * each, each).find_first_not_of(static_cast<char>('a' + rank)) !=
        std::string_view::npos)
      return false;
  return true;
}

void check_large(const Communicator& ranks) {
  const std::size_t each = (std::size_t{5} << 30) / static_cast<std::size_t>(ranks.size()) + 3;
  const std::vector<std::size_t> lengths(static_cast<std::size_t>(ranks.size()), each);
  {
    std::string mine(each, static_cast<char>('a' + ranks.rank())), all(each * lengths.size(), '?');
    ranks.gather_all(mine.data(), lengths, all.data());
    expect(is_by_ranks(all, lengths.size()), "large gather: other bytes");
    ranks.broadcast(all.data(), all.size(), ranks.size() - 1);
  }
  // 40 bytes a unit and more bytes than an int counts in all.
  const auto units = static_cast<std::int64_t>(each / 40);
  const std::vector<std::int64_t> counts(lengths.size(), units / ranks.size());
  const Exchange plan(40, counts, counts);
  const std::string from(40 * static_cast<std::size_t>(plan.sent_units()),
                         static_cast<char>('a' + ranks.rank()));
  std::string to(from.size(), '?');
  ranks.exchange(plan, from.data(), to.data());
  expect(is_by_ranks(to, lengths.size()), "large exchange: other bytes");
}

// The last process comes late: the others see that, and all meet in the end.
void check_meeting(mpi::Session& session, const Communicator& ranks) {
  using namespace std::chrono_literals;
  expect(session.all_here(10s), "meeting: nobody is missing");
  const bool late = ranks.rank() == ranks.size() - 1;
  if (late && !ranks.alone()) std::this_thread::sleep_for(300ms);
  expect(session.all_here(late ? 10s : 30ms) == late, "meeting: who was missing");
  expect(late || session.all_here(10s), "meeting: not all came");
}

}  // namespace

int main(int argc, char** argv) {
  mpi::Session session;
  try {
    const Communicator ranks = session.communicator();
    if (argc > 1 && std::string_view(argv[1]) == "large") {
      check_large(ranks);
      return 0;
    }
    check_conformance(ranks);
    check_group(ranks);
    check_own_messages();
    check_refusals(ranks);
    expect(session.communicator_of_node().size() == ranks.size(), "node: not all are on this one");
    check_meeting(session, ranks);
    if (ranks.is_root()) std::cout << ranks.size() << " processes conform\n";
  } catch (const std::exception& error) {
    std::cerr << "test_mpi: " << error.what() << '\n';
    session.abort(1);
  }
}
