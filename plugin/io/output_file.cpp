#include "synovia/io/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace synovia
{

namespace
{
[[noreturn]] void FailToWrite(const std::string &subject,
                              const std::string &reason)
{
   throw std::runtime_error("cannot write " + subject + ": " + reason);
}

int Flags(OutputFile::Mode mode)
{
   switch (mode)
   {
   case OutputFile::Mode::truncate:
      return O_CREAT | O_TRUNC;
   case OutputFile::Mode::append:
      return O_CREAT | O_APPEND;
   default:
      return 0;
   }
}

/// Calls @a write_some with what is to be written, as often as it takes; says
/// whether it succeeded.
template <typename WriteSome>
bool WriteAll(const char *bytes, std::size_t count, WriteSome write_some)
{
   for (std::size_t done = 0; done < count;)
   {
      const ssize_t written = write_some(bytes + done, count - done, done);
      if (written >= 0)
      {
         done += written;
      }
      else if (errno != EINTR)
      {
         return false;
      }
   }
   return true;
}

std::string InQuotes(const std::string &path)
{
   return "'" + path + "'";
}
} // namespace

OutputFile::OutputFile(const std::string &path, Mode mode,
                       const std::string &subject_)
   : subject(subject_.empty() ? InQuotes(path) : subject_),
     descriptor(open(path.c_str(), O_WRONLY | O_CLOEXEC | Flags(mode), 0666))
{
   if (descriptor < 0)
   {
      Fail();
   }
}

OutputFile::~OutputFile()
{
   if (descriptor >= 0)
   {
      close(descriptor);
   }
}

void OutputFile::Fail() const
{
   FailToWrite(subject, std::strerror(errno));
}

void OutputFile::Write(const char *bytes, std::size_t count)
{
   if (!WriteAll(bytes, count,
                 [&](const char *from, std::size_t n, std::size_t)
                 { return write(descriptor, from, n); }))
   {
      Fail();
   }
}

void OutputFile::WriteAt(std::size_t begin, const char *bytes,
                         std::size_t count)
{
   if (!WriteAll(bytes, count,
                 [&](const char *from, std::size_t n, std::size_t done)
                 { return pwrite(descriptor, from, n, begin + done); }))
   {
      Fail();
   }
}

void OutputFile::Sync()
{
   if (fsync(descriptor) != 0)
   {
      Fail();
   }
}

void OutputFile::Close()
{
   const bool closed = close(descriptor) == 0;
   descriptor = -1;
   if (!closed)
   {
      Fail();
   }
}

void ReplaceFile(const std::string &path, const char *bytes, std::size_t count)
{
   const std::string fresh = path + ".new";
   std::error_code error;
   try
   {
      OutputFile file(fresh, OutputFile::Mode::truncate, InQuotes(path));
      file.Write(bytes, count);
      file.Close();
   }
   catch (const std::runtime_error &)
   {
      std::filesystem::remove(fresh, error);
      throw;
   }
   std::filesystem::rename(fresh, path, error);
   if (error)
   {
      const std::string reason = error.message();
      std::filesystem::remove(fresh, error);
      FailToWrite(InQuotes(path), reason);
   }
}

} // namespace synovia
