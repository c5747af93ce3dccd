// Many inputs, each by a shell of its own: what is run, what is kept, and what one poisoned input does to the others.

#include "host/support/file.h"
#include "tools/batch/batch.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <unistd.h>

namespace tegument::batch {
namespace {

namespace fs = std::filesystem;

class Batches : public testing::Test {
protected:
    Batches() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~Batches() override {
        std::error_code code;
        fs::remove_all(folder_, code);
    }

    std::string write(const std::string& name, const std::string& text) {
        EXPECT_TRUE(writeFile(folder_ / name, text));
        return (folder_ / name).string();
    }

    /// A batch that hands the input to a shell script as $0, which says that it has read it.
    Batch shell(const std::string& script) {
        return {.program = "/bin/sh",
                .programIdentity = "1",
                .words = {"-c", "printf 'r%s\\0' \"$0\" >> \"$TEGUMENT_FILES_USED\"; " + script, "{}"},
                .results = folder_ / "results",
                .timeLimit = 20,
                .maxBytes = 0,
                .jobs = 4};
    }

    struct Sums {
        int done = 0; // now
        int before = 0;
        int failed = 0;
        bool operator==(const Sums&) const = default;
    };

    Sums run(const std::vector<std::string>& inputs, const Batch& batch) {
        Sums sums;
        const auto ran = runBatch(inputs, batch, [&](const Record& record, bool wasDone) {
            ++(wasDone ? sums.before : isDone(record) ? sums.done : sums.failed);
        });
        EXPECT_TRUE(ran) << format(ran.error());
        return sums;
    }

    std::map<std::string, Record> records() {
        std::map<std::string, Record> all;
        const auto read = readRecords(folder_ / "results");
        EXPECT_TRUE(read) << format(read.error());
        if (read)
            for (const Record& record : *read)
                all[fs::path(record.input).filename().string()] = record;
        return all;
    }

    fs::path folder_ = fs::temp_directory_path() / ("tegument-batch-" + std::to_string(::getpid()));
};

TEST_F(Batches, take_patterns_and_lists_each_input_once) {
    const std::string a = write("a.ply", "a");
    const std::string b = write("b.ply", "b");
    const std::string list = write("list.txt", "# scans\n\n" + b + "\r\n  somewhere else.ply  \n" + a + "\n");
    const auto inputs = inputsOf({(folder_ / "*.ply").string()}, list);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(*inputs, (std::vector<std::string>{a, b, "somewhere else.ply"}));
    EXPECT_EQ(inputsOf({(folder_ / "*.obj").string()}, "").error().diagnostics.at(0).code, 8102);
    EXPECT_EQ(inputsOf({}, "").error().diagnostics.at(0).code, 8102);
    EXPECT_FALSE(inputsOf({}, (folder_ / "none.txt").string()));
}

TEST(BatchCommands, fill_their_places_and_never_write_two_inputs_to_one_file) {
    EXPECT_EQ(commandFor({"prep", "{}", "-o", "out/{name}.glb", "{file}|{path}"}, "scans/a.b.ply"),
              (std::vector<std::string>{"prep", "scans/a.b.ply", "-o", "out/a.b.glb", "a.b.ply|scans/a.b"}));
    const std::vector<std::string> inputs{"x/scan.ply", "y/scan.ply"};
    const auto last = [](const std::vector<std::string>& command) { return std::vector{command.back()}; };
    const auto codeOf = [&](const std::vector<std::string>& words) {
        const auto differ = commandsDiffer(words, inputs, last);
        return differ ? 0 : differ.error().diagnostics.at(0).code;
    };
    EXPECT_EQ(codeOf({"prep", "{}", "-o", "{name}.glb"}), 8104);
    EXPECT_EQ(codeOf({"prep", "{}", "-o", "all.glb"}), 8104) << "a fixed name, too";
    EXPECT_EQ(codeOf({"prep", "{}", "-o", "x/../{name}.glb"}), 8104);
    EXPECT_EQ(codeOf({"prep", "{}", "-o", "y/./scan.ply"}), 8104) << "an input";
    EXPECT_EQ(codeOf({"prep", "{}", "-o", "{path}.glb"}), 0);
    EXPECT_EQ(codeOf({"check", "{name}"}), 8103);
}

TEST_F(Batches, run_again_only_what_is_missing_failed_or_changed) {
    const std::vector<std::string> inputs{write("a", "1"), write("b", "1"), write("c", "fails")};
    Batch batch = shell("grep -q fails \"$0\" && exit 1; echo '{\"read\": true}'");
    EXPECT_EQ(run(inputs, batch), (Sums{.done = 2, .before = 0, .failed = 1}));
    EXPECT_EQ(run(inputs, batch), (Sums{.done = 0, .before = 2, .failed = 1}));
    write("a", "2");
    write("c", "mended");
    EXPECT_EQ(run(inputs, batch), (Sums{.done = 2, .before = 1, .failed = 0}));
    EXPECT_EQ(run(inputs, batch), (Sums{.done = 0, .before = 3, .failed = 0}));
    batch.programIdentity = "2";
    EXPECT_EQ(run(inputs, batch).done, 3) << "another program may do it otherwise";
}

TEST_F(Batches, make_again_what_was_written_and_is_not_there_as_it_was) {
    const std::vector<std::string> inputs{write("a", "1"), write("b", "2")};
    const Batch batch = shell("cp \"$0\" \"$0.out\"; printf 'w%s\\0' \"$0.out\" >> \"$TEGUMENT_FILES_USED\"");
    EXPECT_EQ(run(inputs, batch).done, 2);
    EXPECT_EQ(run(inputs, batch).before, 2);
    fs::remove(folder_ / "a.out");
    EXPECT_EQ(run(inputs, batch), (Sums{.done = 1, .before = 1, .failed = 0})) << "gone";
    EXPECT_EQ(*readFile(folder_ / "a.out"), "1");
    for (const char* other : {"", "3", "22"}) {
        write("b.out", other);
        EXPECT_EQ(run(inputs, batch), (Sums{.done = 1, .before = 1, .failed = 0})) << other;
        EXPECT_EQ(*readFile(folder_ / "b.out"), "2");
    }
}

TEST_F(Batches, stop_where_two_inputs_have_written_the_same_file) {
    const std::vector<std::string> inputs{write("a", "1"), write("b", "2")};
    const std::string both = (folder_ / "both").string();
    const auto ran = runBatch(inputs, shell("touch '" + both + "'; printf 'w%s\\0' '" + both + "' >> \"$TEGUMENT_FILES_USED\""), {});
    ASSERT_FALSE(ran);
    EXPECT_EQ(ran.error().diagnostics.at(0).code, 8104);
}

TEST_F(Batches, let_a_poisoned_input_fail_alone) {
    Batch batch = shell("case \"$0\" in"
                        " *slow) sleep 60;;"
                        " *greedy) exec awk 'BEGIN { for (s = \"xxxxxxxxxxxxxxxx\"; ; s = s s) n = length(s) }';;"
                        " *crash) kill -SEGV $$;;"
                        " *loud) yes | head -c 90000000;;"
                        " *) echo done;; esac");
    batch.timeLimit = 3;
    batch.maxBytes = 256U << 20U;
    EXPECT_EQ(run({"slow", "greedy", "crash", "loud", "good", "fine"}, batch), (Sums{.done = 3, .before = 0, .failed = 3}));
    const auto all = records();
    EXPECT_EQ(stateOf(all.at("slow")), "out of time");
    EXPECT_EQ(stateOf(all.at("crash")), "killed by signal 11");
    EXPECT_FALSE(isDone(all.at("greedy"))) << stateOf(all.at("greedy"));
    EXPECT_LT(all.at("greedy").peakBytes, 300U << 20U);
    EXPECT_LT(all.at("loud").result.size(), 5000U);
    EXPECT_EQ(all.at("good").result, "done\n");
}

TEST_F(Batches, leave_no_record_of_what_was_cut_off_and_none_that_is_half) {
    const std::string input = write("a", "1");
    const Batch batch = shell("echo '{}'");
    fs::create_directories(folder_ / "results" / "records");
    write("results/records/0123.json.tmp.elsewhere.7.1", "{\"input\": \"a");
    EXPECT_EQ(run({input}, batch).done, 1);
    EXPECT_EQ(records().size(), 1U) << "what a writer that died left behind is none";
    write("results/records/torn.json", "{\"input\": \"a");
    const auto torn = readRecords(folder_ / "results");
    ASSERT_FALSE(torn);
    EXPECT_EQ(torn.error().diagnostics.at(0).code, 8105);
    EXPECT_EQ(readRecords(folder_ / "nothing").error().diagnostics.at(0).code, 8106);
}

TEST_F(Batches, refuse_a_record_whose_numbers_do_not_fit) {
    const std::string input = write("a", "1");
    EXPECT_EQ(run({input}, shell("echo '{}'")).done, 1);
    const Record good = readRecords(folder_ / "results")->at(0);
    const fs::path file = recordFile(folder_ / "results", good);
    const std::string text = *readFile(file);
    for (const auto& [name, value] : {std::pair{"exit_code", "1e36"},
                                      {"exit_code", "2147483648"},
                                      {"exit_code", "0.5"},
                                      {"peak_bytes", "-1"},
                                      {"peak_bytes", "1e300"},
                                      {"peak_bytes", "true"}}) {
        nlohmann::ordered_json record = nlohmann::ordered_json::parse(text);
        record[name] = nlohmann::ordered_json::parse(value);
        ASSERT_TRUE(writeFile(file, record.dump()));
        const auto read = readRecord(file);
        ASSERT_FALSE(read) << name << " " << value;
        EXPECT_EQ(read.error().diagnostics.at(0).code, 8105) << name << " " << value;
        EXPECT_NE(format(read.error()).find(name), std::string::npos) << format(read.error());
    }
}

TEST_F(Batches, are_a_table_with_columns_of_what_was_printed) {
    const Batch batch = shell("case \"$0\" in *bad) echo 'a: error TG1101: no' >&2; exit 1;; *) echo \"{\\\"mesh\\\": {\\\"faces\\\": 7}, "
                              "\\\"rows\\\": [${#0}]}\";; esac");
    run({"a", "bad", "c, \"d\"|<"}, batch);
    const auto all = readRecords(folder_ / "results");
    ASSERT_TRUE(all);
    const Rows table = tableOf(*all, {"/mesh/faces", "/rows/0", "none"});
    ASSERT_EQ(table.size(), 4U);
    EXPECT_EQ(table[0], (std::vector<std::string>{"input", "state", "seconds", "MiB", "faces", "0", "none", "message"}));
    EXPECT_EQ(table[1][0], "bad") << "what failed stands first";
    EXPECT_EQ(table[1].back(), "a: error TG1101: no");
    EXPECT_EQ(table[2][4], "7");
    EXPECT_EQ(table[2][5], "1");
    EXPECT_EQ(table[2][6], "");
    EXPECT_EQ(pageOf(table).sections.at(0).at("rows").size(), 3U);
}

TEST_F(Batches, of_many_at_a_time_run_each_input_once) {
    std::vector<std::string> inputs;
    for (int i = 0; i < 200; ++i)
        inputs.push_back("input " + std::to_string(i));
    Batch batch = shell("echo \"$0\" >> '" + (folder_ / "seen").string() + "'");
    batch.jobs = 16;
    EXPECT_EQ(run(inputs, batch).done, 200);
    const auto seen = readFile(folder_ / "seen");
    ASSERT_TRUE(seen);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(*seen, '\n')), inputs.size());
    EXPECT_EQ(records().size(), inputs.size());
}

} // namespace
} // namespace tegument::batch
