#pragma once

#include <mpi.h>

#include <stdexcept>
#include <string>

namespace synovia
{

/// What a user can put right: the text says what, where and what to do.
///
/// Synovia throws it on all ranks of the communicator alike, so that a caller
/// may catch it and go on, or let it end the program through RunMain().
class Error : public std::runtime_error
{
public:
   using std::runtime_error::runtime_error;
};

/// Collective over @a comm. The text of the lowest rank whose own is not empty,
/// on every rank; empty if there is none.
std::string AgreeOnText(MPI_Comm comm, const std::string &local_text);

/// Collective over @a comm. Throws Error on every rank, with the text of the
/// lowest rank that has one, if @a local_message is not empty on any rank.
void ThrowIfAny(MPI_Comm comm, const std::string &local_message);

/// Calls @a body and gives the exit status of the program: what the body
/// returns, or 1 after an Error, whose text rank 0 writes to standard error.
/// An exception of any other kind is taken to be of one rank only and aborts
/// all ranks. MPI must be initialized.
int RunMain(const std::string &program, int (*body)(int, char **), int argc,
            char **argv);

} // namespace synovia
