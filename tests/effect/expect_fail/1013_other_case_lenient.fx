// expect: 1013_other_case_lenient.fx(2,10): warning TG1013: 'Parts/COMMON.fxh' is spelt 'tests/effect/expect_fail/parts/common.fxh' on disk; other systems tell cases apart
#include "Parts/COMMON.fxh"
technique T { pass P { } }
