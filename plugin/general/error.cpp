#include "synovia/general/error.hpp"

#include <iostream>

namespace synovia
{

std::string AgreeOnText(MPI_Comm comm, const std::string &local_text)
{
   int rank = 0;
   int size = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &size);
   const int mine = local_text.empty() ? size : rank;
   int first = size;
   MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
   if (first == size)
   {
      return "";
   }
   int length = static_cast<int>(local_text.size());
   MPI_Bcast(&length, 1, MPI_INT, first, comm);
   std::string text = local_text;
   text.resize(length);
   MPI_Bcast(text.data(), length, MPI_CHAR, first, comm);
   return text;
}

void ThrowIfAny(MPI_Comm comm, const std::string &local_message)
{
   const std::string message = AgreeOnText(comm, local_message);
   if (!message.empty())
   {
      throw Error(message);
   }
}

int RunMain(const std::string &program, int (*body)(int, char **), int argc,
            char **argv)
{
   int rank = 0;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   try
   {
      return body(argc, argv);
   }
   catch (const Error &error)
   {
      if (rank == 0)
      {
         std::cerr << program << ": error: " << error.what() << std::endl;
      }
      return 1;
   }
   catch (const std::exception &error)
   {
      std::cerr << program << ": internal error on rank " << rank << ": "
                << error.what() << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 2);
      return 2;
   }
}

} // namespace synovia
