// Counts what a program says over MPI, PETSc and hypre included, without a change to it. To be loaded before it:
//   mpirun -n 4 -x LD_PRELOAD=libcount_messages.so lampblack run deck.yaml
// When MPI ends, rank 0 prints a line for each kind of call: the calls and bytes of the rank that made most, and the
// mean. Bytes are those that a rank sends; those of MPI_Alltoall and MPI_Alltoallv to itself count as well. Two
// runs of different length give what a step takes. What is sent by MPI-IO's own messages is not seen.
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <unordered_map>

namespace {

enum Kind {
  Allreduce,
  Alltoall,
  Alltoallv,
  Allgather,
  Exscan,
  Bcast,
  Reduce,
  Gather,
  Barrier,
  Halo,
  Message,
  Receive,
  Waiting,
  Kinds
};
constexpr std::array<const char*, Kinds> names{"allreduce", "alltoall", "alltoallv", "allgather", "exscan",
                                               "bcast",     "reduce",   "gather",    "barrier",   "halo",
                                               "message",   "receive",  "wait"};
std::array<double, Kinds> calls{}, bytes{};
std::unordered_map<MPI_Request, std::pair<Kind, double>> persistent;  // messages that are sent again and again

double sizeOf(double count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return count * size;
}

void count(Kind kind, double size) {
  ++calls[kind];
  bytes[kind] += size;
}

int sizeOf(MPI_Comm comm) {
  int ranks = 1;
  PMPI_Comm_size(comm, &ranks);
  return ranks;
}

void started(MPI_Request request) {
  if (const auto found = persistent.find(request); found != persistent.end())
    count(found->second.first, found->second.second);
}

}  // namespace

extern "C" {

int MPI_Allreduce(const void* from, void* to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  count(Allreduce, sizeOf(n, type));
  return PMPI_Allreduce(from, to, n, type, op, comm);
}
int MPI_Iallreduce(const void* from, void* to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
                   MPI_Request* request) {
  count(Allreduce, sizeOf(n, type));
  return PMPI_Iallreduce(from, to, n, type, op, comm, request);
}
int MPI_Reduce(const void* from, void* to, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  count(Reduce, sizeOf(n, type));
  return PMPI_Reduce(from, to, n, type, op, root, comm);
}
int MPI_Exscan(const void* from, void* to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  count(Exscan, sizeOf(n, type));
  return PMPI_Exscan(from, to, n, type, op, comm);
}
int MPI_Scan(const void* from, void* to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  count(Exscan, sizeOf(n, type));
  return PMPI_Scan(from, to, n, type, op, comm);
}
int MPI_Bcast(void* values, int n, MPI_Datatype type, int root, MPI_Comm comm) {
  count(Bcast, sizeOf(n, type));
  return PMPI_Bcast(values, n, type, root, comm);
}
int MPI_Barrier(MPI_Comm comm) {
  count(Barrier, 0.0);
  return PMPI_Barrier(comm);
}
int MPI_Alltoall(const void* from, int n, MPI_Datatype type, void* to, int m, MPI_Datatype toType, MPI_Comm comm) {
  count(Alltoall, sizeOf(n, type) * sizeOf(comm));
  return PMPI_Alltoall(from, n, type, to, m, toType, comm);
}
int MPI_Alltoallv(const void* from, const int* n, const int* start, MPI_Datatype type, void* to, const int* m,
                  const int* toStart, MPI_Datatype toType, MPI_Comm comm) {
  count(Alltoallv, sizeOf(std::accumulate(n, n + sizeOf(comm), 0.0), type));
  return PMPI_Alltoallv(from, n, start, type, to, m, toStart, toType, comm);
}
int MPI_Allgather(const void* from, int n, MPI_Datatype type, void* to, int m, MPI_Datatype toType, MPI_Comm comm) {
  count(Allgather, from == MPI_IN_PLACE ? sizeOf(m, toType) : sizeOf(n, type));
  return PMPI_Allgather(from, n, type, to, m, toType, comm);
}
int MPI_Allgatherv(const void* from, int n, MPI_Datatype type, void* to, const int* m, const int* start,
                   MPI_Datatype toType, MPI_Comm comm) {
  count(Allgather, from == MPI_IN_PLACE ? 0.0 : sizeOf(n, type));
  return PMPI_Allgatherv(from, n, type, to, m, start, toType, comm);
}
int MPI_Gather(const void* from, int n, MPI_Datatype type, void* to, int m, MPI_Datatype toType, int root,
               MPI_Comm comm) {
  count(Gather, from == MPI_IN_PLACE ? 0.0 : sizeOf(n, type));
  return PMPI_Gather(from, n, type, to, m, toType, root, comm);
}
int MPI_Gatherv(const void* from, int n, MPI_Datatype type, void* to, const int* m, const int* start,
                MPI_Datatype toType, int root, MPI_Comm comm) {
  count(Gather, from == MPI_IN_PLACE ? 0.0 : sizeOf(n, type));
  return PMPI_Gatherv(from, n, type, to, m, start, toType, root, comm);
}
int MPI_Isend(const void* from, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  constexpr int tagOfHalo = 11;  // core/halo_exchange.cpp
  count(tag == tagOfHalo ? Halo : Message, sizeOf(n, type));
  return PMPI_Isend(from, n, type, to, tag, comm, request);
}
int MPI_Send(const void* from, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count(Message, sizeOf(n, type));
  return PMPI_Send(from, n, type, to, tag, comm);
}
int MPI_Irecv(void* into, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request) {
  count(Receive, sizeOf(n, type));
  return PMPI_Irecv(into, n, type, from, tag, comm, request);
}
int MPI_Waitall(int n, MPI_Request* requests, MPI_Status* statuses) {
  if (n > 0) count(Waiting, 0.0);
  return PMPI_Waitall(n, requests, statuses);
}
int MPI_Send_init(const void* from, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  const int error = PMPI_Send_init(from, n, type, to, tag, comm, request);
  persistent[*request] = {Message, sizeOf(n, type)};
  return error;
}
int MPI_Recv_init(void* into, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request) {
  const int error = PMPI_Recv_init(into, n, type, from, tag, comm, request);
  persistent[*request] = {Receive, sizeOf(n, type)};
  return error;
}
int MPI_Start(MPI_Request* request) {
  started(*request);
  return PMPI_Start(request);
}
int MPI_Startall(int n, MPI_Request* requests) {
  std::for_each(requests, requests + n, started);
  return PMPI_Startall(n, requests);
}
int MPI_Finalize() {
  std::array<double, 2 * Kinds> own{}, most{}, all{};
  std::copy(calls.begin(), calls.end(), own.begin());
  std::copy(bytes.begin(), bytes.end(), own.begin() + Kinds);
  PMPI_Reduce(own.data(), most.data(), 2 * Kinds, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
  PMPI_Reduce(own.data(), all.data(), 2 * Kinds, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const int ranks = sizeOf(MPI_COMM_WORLD);
  if (rank == 0) {
    std::fprintf(stderr, "messages %-10s %14s %14s %16s %16s\n", "", "most calls", "mean calls", "most bytes",
                 "mean bytes");
    for (std::size_t k = 0; k < Kinds; ++k)
      if (all[k] > 0.0)
        std::fprintf(stderr, "messages %-10s %14.0f %14.1f %16.0f %16.1f\n", names[k], most[k], all[k] / ranks,
                     most[Kinds + k], all[Kinds + k] / ranks);
  }
  return PMPI_Finalize();
}

}  // extern "C"
