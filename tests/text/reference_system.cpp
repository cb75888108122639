// Names of spatial reference systems.

#include "text/reference_system.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using roam::reference_name;

TEST(ReferenceName, OfADefinitionOfManyLinesIsItsFirst) {
  EXPECT_EQ(reference_name("PROJCS[\"ETRS89 / UTM zone 32N\",\n    GEOGCS[\"ETRS89\",\n        DATUM[\"D\"]]]"),
            "ETRS89 / UTM zone 32N");
  EXPECT_EQ(reference_name("COMPD_CS (\n\"a + b\", VERT_CS[\"b\"])"), "a + b");
}

TEST(ReferenceName, OfAnyOtherTextIsAllOfIt) {
  for (const char* text : {"EPSG:32632", "ENU:47.1,8.2", "+proj=utm +zone=32", "", "PROJCS", "PROJCS[", "PROJCS[\"",
                           "PROJCS[\"\"]", "PROJCS[x, \"y\"]", "[\"a\"]"}) {
    EXPECT_EQ(reference_name(text), text);
  }
  EXPECT_LE(reference_name("PROJCS[\"" + std::string(5000, 'a') + "\"]").size(), 130u);
}

}  // namespace
