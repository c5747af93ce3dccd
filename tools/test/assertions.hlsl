// What `tegument test` puts in front of a file of tests. Names that begin with tgTest are called by what it writes, all others by tests.

static uint tgCase = 0u;                   // counts the cases of a test
static uint tgThread = 0u;                 // TG_GROUP_TEST: the thread in its group
static uint3 tgThreadID = uint3(0, 0, 0);  // the same along three axes
static float2 tgQuad = float2(0.0, 0.0);   // TG_PIXEL_TEST: 0 or 1 along both axes, the pixel of the quad

cbuffer tgTestRun // in the order of Program::run
{
    uint tgTestFirst;   // case
    uint tgTestEnd;     // behind the last case
    uint tgTestWanted;  // invocation whose values are noted; none: 0xffffffff
    uint tgTestOrder;   // of the threads of a group: 0 to 7
    uint tgTestSeed;
    uint tgTestLoopMost;
    uint tgTestNotesAt; // in tgTestOut
    uint tgTestValuesAt;
    uint tgTestCases;
};

// Of each site 22 numbers: runs, failures, first invocation that failed, largest error (absolute, relative, ulp), 16 classes of errors in ulp.
// Behind them whether a loop did not end, then what was noted: site + 1, kind and components, four numbers; behind those the counts of coverage,
// then the values of properties, case by case: four numbers, the largest step, how many numbers there are.
RWStructuredBuffer<uint> tgTestOut;
StructuredBuffer<float> tgTestTable;

static const uint kTgTestSite = 22u;
static const uint kTgTestNoted = 6u;
static const uint kTgTestMostNotes = 256u;
static const uint kTgTestProperty = 6u;

static uint tgTestInvocation = 0u;
static uint tgTestNotes = 0u;
static uint tgTestSteps = 0u;
static bool tgTestSilent = false; // beyond the last case
static bool tgTestLost = false;   // in a loop that does not end
static bool tgTestTraced = false; // a NaN was seen

struct TgTestValue
{
    uint4 bits;
    uint kind; // 0 float, 1 int, 2 uint, 3 bool
    uint count;
};

TgTestValue tgTestMake(uint4 bits, uint kind, uint count)
{
    TgTestValue made;
    made.bits = bits;
    made.kind = kind;
    made.count = count;
    return made;
}

TgTestValue tgTestOf(float x) { return tgTestMake(uint4(asuint(x), 0u, 0u, 0u), 0u, 1u); }
TgTestValue tgTestOf(float2 x) { return tgTestMake(uint4(asuint(x), 0u, 0u), 0u, 2u); }
TgTestValue tgTestOf(float3 x) { return tgTestMake(uint4(asuint(x), 0u), 0u, 3u); }
TgTestValue tgTestOf(float4 x) { return tgTestMake(asuint(x), 0u, 4u); }
TgTestValue tgTestOf(int x) { return tgTestMake(uint4(asuint(x), 0u, 0u, 0u), 1u, 1u); }
TgTestValue tgTestOf(int2 x) { return tgTestMake(uint4(asuint(x), 0u, 0u), 1u, 2u); }
TgTestValue tgTestOf(int3 x) { return tgTestMake(uint4(asuint(x), 0u), 1u, 3u); }
TgTestValue tgTestOf(int4 x) { return tgTestMake(asuint(x), 1u, 4u); }
TgTestValue tgTestOf(uint x) { return tgTestMake(uint4(x, 0u, 0u, 0u), 2u, 1u); }
TgTestValue tgTestOf(uint2 x) { return tgTestMake(uint4(x, 0u, 0u), 2u, 2u); }
TgTestValue tgTestOf(uint3 x) { return tgTestMake(uint4(x, 0u), 2u, 3u); }
TgTestValue tgTestOf(uint4 x) { return tgTestMake(x, 2u, 4u); }
TgTestValue tgTestOf(bool x) { return tgTestMake(uint4(x ? 1u : 0u, 0u, 0u, 0u), 3u, 1u); }

// Of which DXC would take a row: no assertion has them.
struct TgTestMatrix { float none; };
TgTestMatrix tgTestNone() { TgTestMatrix none; none.none = 0.0; return none; }
TgTestMatrix tgTestOf(float3x3 x) { return tgTestNone(); }
TgTestMatrix tgTestOf(float4x4 x) { return tgTestNone(); }
TgTestMatrix tgTestOf(float3x4 x) { return tgTestNone(); }
TgTestMatrix tgTestOf(float4x3 x) { return tgTestNone(); }

float4 tgTestNumbers(TgTestValue x)
{
    if (x.kind == 0u) return asfloat(x.bits);
    if (x.kind == 1u) return float4(asint(x.bits));
    return float4(x.bits);
}

// As many components as the other has, where it is one number.
TgTestValue tgTestSpread(TgTestValue x, TgTestValue other)
{
    if (x.count != 1u || other.count == 1u) return x;
    return tgTestMake(x.bits.xxxx, x.kind, other.count);
}

bool tgTestIsNan(uint bits) { return (bits & 0x7fffffffu) > 0x7f800000u; }

void tgTestNote(uint site, TgTestValue x)
{
    if (tgTestInvocation != tgTestWanted || tgTestSilent || tgTestNotes >= kTgTestMostNotes) return;
    const uint at = tgTestNotesAt + tgTestNotes * kTgTestNoted;
    tgTestOut[at] = site + 1u;
    tgTestOut[at + 1u] = x.kind * 8u + x.count;
    tgTestOut[at + 2u] = x.bits.x;
    tgTestOut[at + 3u] = x.bits.y;
    tgTestOut[at + 4u] = x.bits.z;
    tgTestOut[at + 5u] = x.bits.w;
    tgTestNotes += 1u;
}

void tgTestJudge(uint site, bool passed)
{
    if (tgTestSilent) return;
    InterlockedAdd(tgTestOut[site * kTgTestSite], 1u);
    if (passed) return;
    InterlockedAdd(tgTestOut[site * kTgTestSite + 1u], 1u);
    InterlockedMin(tgTestOut[site * kTgTestSite + 2u], tgTestInvocation);
}

struct TgTestTolerance
{
    float absolute;
    float relative;
    uint ulp;
};

TgTestTolerance tgTestTolerated(float absolute, float relative, uint ulp)
{
    TgTestTolerance made;
    made.absolute = absolute;
    made.relative = relative;
    made.ulp = ulp;
    return made;
}

TgTestTolerance tgAbsolute(float most) { return tgTestTolerated(most, 0.0, 0u); }
TgTestTolerance tgRelative(float most) { return tgTestTolerated(0.0, most, 0u); }
TgTestTolerance tgUlp(uint most) { return tgTestTolerated(0.0, 0.0, most); }

TgTestTolerance tgTestEither(TgTestTolerance a, TgTestTolerance b)
{
    return tgTestTolerated(max(a.absolute, b.absolute), max(a.relative, b.relative), max(a.ulp, b.ulp));
}

uint tgTestOrdered(uint bits) { return (bits & 0x80000000u) != 0u ? 0x80000000u - (bits & 0x7fffffffu) : 0x80000000u + bits; }

// Numbers of the format between the two.
uint tgTestUlps(float a, float b)
{
    const uint x = tgTestOrdered(asuint(a));
    const uint y = tgTestOrdered(asuint(b));
    return max(x, y) - min(x, y);
}

void tgTestCompared(uint site, bool passed, TgTestValue value, TgTestValue expected)
{
    tgTestJudge(site, passed);
    if (passed) return;
    tgTestNote(site, value);
    tgTestNote(site, expected);
}

void tgTestEqual(uint site, TgTestValue a, TgTestValue b)
{
    const TgTestValue value = tgTestSpread(a, b);
    const TgTestValue expected = tgTestSpread(b, a);
    const bool exact = value.kind == expected.kind && value.kind != 0u;
    const float4 x = tgTestNumbers(value);
    const float4 y = tgTestNumbers(expected);
    bool passed = value.count == expected.count;
    for (uint i = 0u; i < 4u; i++)
        if (i < value.count && (exact ? value.bits[i] != expected.bits[i] : !(x[i] == y[i]))) passed = false;
    tgTestCompared(site, passed, value, expected);
}

void tgTestNear(uint site, TgTestValue a, TgTestValue b, TgTestTolerance tolerance)
{
    const TgTestValue value = tgTestSpread(a, b);
    const TgTestValue expected = tgTestSpread(b, a);
    const float4 x = tgTestNumbers(value);
    const float4 y = tgTestNumbers(expected);
    bool passed = value.count == expected.count;
    float absolute = 0.0;
    float relative = 0.0;
    uint ulps = 0u;
    for (uint i = 0u; i < 4u; i++)
    {
        if (i >= value.count) continue;
        const bool isNan = tgTestIsNan(asuint(x[i])) || tgTestIsNan(asuint(y[i]));
        if (!isNan && x[i] == y[i]) continue;
        const float difference = isNan ? asfloat(0x7f800000u) : abs(x[i] - y[i]);
        const uint apart = isNan ? 0xffffffffu : tgTestUlps(x[i], y[i]);
        if (isNan || !(difference <= tolerance.absolute || difference <= tolerance.relative * abs(y[i]) || apart <= tolerance.ulp))
            passed = false;
        absolute = max(absolute, difference);
        relative = max(relative, y[i] == 0.0 ? asfloat(0x7f800000u) : difference / abs(y[i]));
        ulps = max(ulps, apart);
    }
    tgTestCompared(site, passed, value, expected);
    if (tgTestSilent) return;
    const uint at = site * kTgTestSite;
    InterlockedMax(tgTestOut[at + 3u], asuint(absolute));
    InterlockedMax(tgTestOut[at + 4u], asuint(relative));
    InterlockedMax(tgTestOut[at + 5u], ulps);
    InterlockedAdd(tgTestOut[at + 6u + (ulps < 2u ? ulps : min(15u, uint(firstbithigh(ulps - 1u)) + 2u))], 1u);
}

void tgTestNear(uint site, TgTestValue value, TgTestValue expected, float absolute)
{
    tgTestNear(site, value, expected, tgAbsolute(absolute));
}

void tgTestTrue(uint site, bool passed) { tgTestJudge(site, passed); }

void tgTestFinite(uint site, TgTestValue value)
{
    bool passed = true;
    for (uint i = 0u; i < 4u; i++)
        if (i < value.count && value.kind == 0u && (value.bits[i] & 0x7f800000u) == 0x7f800000u) passed = false;
    tgTestJudge(site, passed);
    if (!passed) tgTestNote(site, value);
}

void tgTestBetween(uint site, TgTestValue value, TgTestValue low, TgTestValue high)
{
    const float4 x = tgTestNumbers(value);
    const float4 least = tgTestNumbers(tgTestSpread(low, value));
    const float4 most = tgTestNumbers(tgTestSpread(high, value));
    bool passed = true;
    for (uint i = 0u; i < 4u; i++)
        if (i < value.count && !(x[i] >= least[i] && x[i] <= most[i])) passed = false;
    tgTestJudge(site, passed);
    if (!passed) tgTestNote(site, value);
}

uint tgTestPlace(uint property) { return tgTestValuesAt + (property * tgTestCases + tgCase) * kTgTestProperty; }
void tgTestRecord(uint property, TgTestValue value, float most)
{
    if (tgTestSilent) return;
    const float4 numbers = tgTestNumbers(value);
    const uint at = tgTestPlace(property);
    for (uint i = 0u; i < 4u; i++)
        tgTestOut[at + i] = asuint(numbers[i]);
    tgTestOut[at + 4u] = asuint(most);
    tgTestOut[at + 5u] = value.count;
}

// What a reference says.
float4 tgTestGiven(uint at) { return asfloat(uint4(tgTestOut[at], tgTestOut[at + 1u], tgTestOut[at + 2u], tgTestOut[at + 3u])); }

// The program compares neighbours.
void tgTestProperty(uint site, uint property, TgTestValue value, float most)
{
    tgTestJudge(site, true);
    tgTestNote(site, value);
    tgTestRecord(property, value, most);
}

// Whether the loop has to be left: it, or all loops together, have taken too many turns, here or in another invocation.
bool tgTestLoop(inout uint turns, uint site)
{
    turns += 1u;
    tgTestSteps += 1u;
    if (!tgTestLost && (turns > tgTestLoopMost || tgTestSteps / 16u > tgTestLoopMost))
    {
        tgTestLost = true;
        tgTestJudge(site, false);
        tgTestOut[tgTestNotesAt - 1u] = 1u;
    }
    if ((tgTestSteps & 4095u) == 0u && tgTestOut[tgTestNotesAt - 1u] != 0u) tgTestLost = true;
    return tgTestLost;
}

// The index where the array has such an element, else the nearest one that it has.
int tgTestAt(int index, uint count, uint site)
{
    if (uint(index) < count) return index;
    tgTestJudge(site, false);
    tgTestNote(site, tgTestOf(index));
    tgTestNote(site, tgTestOf(count));
    return index < 0 ? 0 : int(count) - 1;
}

bool tgTestNan(uint site, TgTestValue x)
{
    bool isNan = false;
    for (uint i = 0u; i < 4u; i++)
        isNan = isNan || (i < x.count && tgTestIsNan(x.bits[i]));
    if (!isNan || tgTestTraced || tgTestInvocation != tgTestWanted) return false;
    tgTestTraced = true;
    tgTestJudge(site, false);
    return true;
}

float tgTestTrace(float x, uint site) { tgTestNan(site, tgTestOf(x)); return x; }
float2 tgTestTrace(float2 x, uint site) { tgTestNan(site, tgTestOf(x)); return x; }
float3 tgTestTrace(float3 x, uint site) { tgTestNan(site, tgTestOf(x)); return x; }
float4 tgTestTrace(float4 x, uint site) { tgTestNan(site, tgTestOf(x)); return x; }

void tgTestReached(uint place)
{
    if (!tgTestSilent) InterlockedAdd(tgTestOut[tgTestNotesAt + kTgTestMostNotes * kTgTestNoted + place], 1u);
}

// Of a condition: the place that counts where it holds, and the next one.
bool tgTestSide(uint place, bool x) { tgTestReached(x ? place : place + 1u); return x; }
bool tgTestSide(uint place, int x) { return tgTestSide(place, x != 0); }
bool tgTestSide(uint place, uint x) { return tgTestSide(place, x != 0u); }
bool tgTestSide(uint place, float x) { return tgTestSide(place, x != 0.0); }
bool2 tgTestSide(uint place, bool2 x) { if (any(x)) tgTestReached(place); if (!all(x)) tgTestReached(place + 1u); return x; }
bool3 tgTestSide(uint place, bool3 x) { if (any(x)) tgTestReached(place); if (!all(x)) tgTestReached(place + 1u); return x; }
bool4 tgTestSide(uint place, bool4 x) { if (any(x)) tgTestReached(place); if (!all(x)) tgTestReached(place + 1u); return x; }

// Which of `count` values of an input this case has, where those before it change `stride` times faster.
uint tgTestDigit(uint stride, uint count) { return tgCase / stride % count; }

// PCG hash (Jarzynski and Olano 2020), 0 to 1.
float tgTestUnit(uint input, uint component)
{
    uint state = (tgCase * 4u + component) * 747796405u + (input * 9781u + tgTestSeed) * 2891336453u + 1u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    state = (state >> 22u) ^ state;
    state = (state ^ (state >> 16u)) * 2246822519u;
    return float((state ^ (state >> 13u)) >> 8u) / 16777215.0;
}

// The thread that takes the place of this one: forwards or backwards, from one of four threads on.
uint tgTestThread(uint index, uint count)
{
    const uint turned = (index + (tgTestOrder / 2u) * (count / 4u)) % count;
    return (tgTestOrder & 1u) != 0u ? count - 1u - turned : turned;
}

float4 tgTestScreenVS(uint index : SV_VertexID) : SV_Position
{
    return float4(index == 1u ? 3.0 : -1.0, index == 2u ? 3.0 : -1.0, 0.0, 1.0);
}
