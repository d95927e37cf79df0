// ranks: 1
//
// Tables of the log file of FEBio become logs.

#include "support/feb_text.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;
} // namespace

TEST_CASE("Tables of a log file become logs")
{
   const std::string plot = "<plotfile type=\"febio\">";
   const auto with = [&](const std::string &tables)
   {
      return Replaced(FebColumn(), plot,
                      "<logfile file=\"a.log\">" + tables + "</logfile>" +
                         plot);
   };
   const FebImport import = ImportFeb(
      with("<node_data data=\"ux;uz;Rz\" file=\"out/n.csv\" delim=\",\">"
           "1:9:4,12</node_data>"
           "<node_data data=\"p;vx\" node_set=\"bottom\"/>"
           "<node_data data=\"p\" node_set=\"@surface:top\"/>"
           "<element_data data=\"sx;J\" elem_set=\"body\" name=\"s\"/>"
           "<element_data data=\"sed\">1</element_data>"
           "<face_data data=\"contact gap\"/>"),
      "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   const std::vector<LogDefinition> &logs = import.setup.output.logs;
   REQUIRE(logs.size() == 4);
   CHECK(logs[0].file == "n.csv");
   CHECK(logs[0].of == LogSubject::nodes);
   CHECK(logs[0].data == std::vector<std::string>{"ux", "uz", "Rz"});
   CHECK(logs[0].numbers == std::vector<int>{1, 5, 9, 12});
   CHECK(logs[0].delimiter == ",");
   CHECK(logs[1].file == "node_data.txt");
   CHECK(logs[1].data == std::vector<std::string>{"p"});
   CHECK(logs[1].numbers == std::vector<int>{1, 2, 3, 4});
   CHECK(logs[2].file == "2_node_data.txt");
   CHECK(logs[2].numbers == std::vector<int>{9, 10, 11, 12});
   CHECK(logs[3].of == LogSubject::elements);
   CHECK(logs[3].numbers == std::vector<int>{1, 2});
   CHECK_THAT(import.report.Text(Fate::approximated),
              Catch::Matchers::Contains("the log leaves out \"vx\""));
   for (const std::string tables :
        {"<node_data data=\"x\">1:a</node_data>",
         "<node_data data=\"x\">3:1</node_data>",
         "<node_data data=\"x\" node_set=\"none\"/>",
         "<element_data data=\"p\" elem_set=\"none\"/>",
         "<rigid_body_data data=\"x\">7</rigid_body_data>"})
   {
      CAPTURE(tables);
      CHECK(ImportFeb(with(tables), "model.feb").report.IsStopped());
   }
}
