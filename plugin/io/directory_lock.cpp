#include "synovia/io/directory_lock.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/general/utc_time.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace synovia
{

namespace
{
constexpr std::size_t longest_note = 512;

std::string ThisProcess()
{
   char host[256] = "";
   gethostname(host, sizeof(host) - 1);
   return "process " + std::to_string(getpid()) + " on " + host + ", since " +
          UtcNow();
}

std::string ReadNote(int descriptor)
{
   std::string note(longest_note, '\0');
   const ssize_t length = pread(descriptor, note.data(), note.size(), 0);
   note.resize(length > 0 ? length : 0);
   return note.empty() ? "which does not say who it is" : note;
}

/// Whether the path still leads to the open file: the run that had the lock
/// may just have removed it.
bool IsAt(const std::string &path, int descriptor)
{
   struct stat opened;
   struct stat named;
   return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
          opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}
} // namespace

DirectoryLock::DirectoryLock(const std::string &directory, MPI_Comm comm)
   : path(directory + "/.synovia-lock")
{
   OnRoot(comm, [&]() { Take(directory); });
   Broadcast(doubt, comm);
}

DirectoryLock::~DirectoryLock()
{
   if (descriptor >= 0)
   {
      // While it is locked: nobody else can have taken it.
      unlink(path.c_str());
      close(descriptor);
   }
}

void DirectoryLock::Take(const std::string &directory)
{
   while (true)
   {
      descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (descriptor < 0)
      {
         throw std::runtime_error("cannot write '" + path +
                                  "': " + std::strerror(errno));
      }
      const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
      const int reason = errno;
      if (locked && IsAt(path, descriptor))
      {
         break;
      }
      const std::string holder =
         !locked && reason == EWOULDBLOCK ? ReadNote(descriptor) : "";
      close(descriptor);
      descriptor = -1;
      if (!holder.empty())
      {
         throw std::runtime_error(
            "the output directory '" + directory +
            "' is that of a run in progress (" + holder +
            "); wait for its end, or name another directory with --output");
      }
      if (!locked)
      {
         doubt = "'" + directory +
                 "' can't be locked: " + std::strerror(reason) +
                 "; start no other run with this output directory";
         return;
      }
   }
   // For messages only: that the disk may be full does not matter here.
   const std::string note = ThisProcess();
   if (ftruncate(descriptor, 0) != 0 ||
       pwrite(descriptor, note.data(), note.size(), 0) < 0)
   {
      return;
   }
}

} // namespace synovia
