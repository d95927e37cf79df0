#pragma once

#include <cstddef>
#include <string>

namespace synovia
{

/// A file that is written without a buffer, and so says at once why it can't
/// be; streams of C++ lose the reason, for one that the disk is full.
///
/// For one process. Errors are std::runtime_error with the name of the file and
/// the reason.
class OutputFile
{
public:
   enum class Mode
   {
      truncate,
      append,
      /// The file is there, and keeps what is not written.
      update
   };
   /// Messages call the file @a subject, or by its path.
   OutputFile(const std::string &path, Mode mode,
              const std::string &subject = "");
   ~OutputFile();
   OutputFile(const OutputFile &) = delete;
   OutputFile &operator=(const OutputFile &) = delete;

   /// Adds the bytes, all of which the system has on return.
   void Write(const char *bytes, std::size_t count);
   void Write(const std::string &bytes) { Write(bytes.data(), bytes.size()); }
   /// The same, but @a begin bytes after the beginning of the file.
   void WriteAt(std::size_t begin, const char *bytes, std::size_t count);
   /// Waits until the disk has them, too.
   void Sync();
   void Close();

private:
   [[noreturn]] void Fail() const;

   std::string subject;
   int descriptor;
};

/// Writes a file in place of one that is there, which stays until the new one
/// is whole. Errors as above.
void ReplaceFile(const std::string &path, const char *bytes, std::size_t count);
inline void ReplaceFile(const std::string &path, const std::string &bytes)
{
   ReplaceFile(path, bytes.data(), bytes.size());
}

} // namespace synovia
