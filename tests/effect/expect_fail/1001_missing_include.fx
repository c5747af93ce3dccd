// expect: 1001_missing_include.fx(2,10): error TG1001: cannot find include file 'nowhere.fxh'; looked for 'tests/effect/expect_fail/nowhere.fxh'
#include "nowhere.fxh"
