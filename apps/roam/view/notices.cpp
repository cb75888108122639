#include "view/notices.h"

#include <cstdio>
#include <osg/Notify>

#include "cli/tell.h"

namespace roam::app {
namespace {

class Notices : public osg::NotifyHandler {
 public:
  void notify(osg::NotifySeverity, const char* message) override {
    std::fputs(printable_lines(message).c_str(), stderr);
  }
};

}  // namespace

void make_notices_printable() { osg::setNotifyHandler(new Notices); }

}  // namespace roam::app
