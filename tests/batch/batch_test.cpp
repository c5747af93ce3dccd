// Many inputs, each by a shell of its own: what is run, what is kept, and what one poisoned input does to the others.

#include "host/support/file.h"
#include "tools/batch/inputs.h"
#include "tools/batch/run.h"
#include "tools/batch/slurm.h"
#include "tools/batch/table.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <set>
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

    /// A batch that hands the input to a shell script as $0.
    Batch shell(const std::string& script) {
        return {.program = "/bin/sh",
                .programIdentity = "1",
                .words = {"-c", script, "{}"},
                .with = {},
                .filesBehind = [](const std::string& word) -> std::vector<fs::path> {
                    std::error_code code;
                    return fs::is_regular_file(word, code) ? std::vector<fs::path>{word} : std::vector<fs::path>{};
                },
                .results = folder_ / "results",
                .timeLimit = 20,
                .maxBytes = 0,
                .jobs = 4};
    }

    Sums run(const std::vector<std::string>& inputs, const Batch& batch) {
        const auto sums = runBatch(inputs, batch, {});
        EXPECT_TRUE(sums) << format(sums.error());
        return sums ? *sums : Sums{};
    }

    std::map<std::string, Record> records() {
        std::map<std::string, Record> all;
        const auto read = readRecords({folder_ / "results"});
        EXPECT_TRUE(read) << format(read.error());
        if (read)
            for (const Record& record : *read)
                all[fs::path(record.input).filename().string()] = record;
        return all;
    }

    fs::path folder_ = fs::temp_directory_path() / ("tegument-batch-" + std::to_string(::getpid()));
};

TEST(Shards, hold_every_input_once) {
    std::vector<std::string> inputs;
    for (int i = 0; i < 101; ++i)
        inputs.push_back(std::to_string(i));
    for (const std::size_t count : {1U, 2U, 7U, 100U, 101U, 250U}) {
        std::multiset<std::string> all;
        std::size_t largest = 0;
        std::size_t smallest = inputs.size();
        for (std::size_t i = 1; i <= count; ++i) {
            const auto part = partOf(inputs, {i, count});
            all.insert(part.begin(), part.end());
            largest = std::max(largest, part.size());
            smallest = std::min(smallest, part.size());
        }
        EXPECT_EQ(all, std::multiset<std::string>(inputs.begin(), inputs.end())) << count;
        EXPECT_LE(largest - smallest, 1U) << count;
    }
    EXPECT_EQ(shardOf("3/100")->index, 3U);
    for (const char* wrong : {"", "3", "0/4", "5/4", "-1/4", "1/0", "a/b", "1/4x", "1 / 4", "1//4"})
        EXPECT_EQ(shardOf(wrong) ? 0 : shardOf(wrong).error().diagnostics.at(0).code, 8101) << wrong;
}

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
    EXPECT_EQ(commandsDiffer({"prep", "{}", "-o", "{name}.glb"}, inputs).error().diagnostics.at(0).code, 8104);
    EXPECT_TRUE(commandsDiffer({"prep", "{}", "-o", "{path}.glb"}, inputs));
    EXPECT_TRUE(commandsDiffer({"check", "{}"}, inputs));
    EXPECT_EQ(commandsDiffer({"check", "{name}"}, {"a"}).error().diagnostics.at(0).code, 8103);
}

TEST_F(Batches, run_again_only_what_is_missing_failed_or_changed) {
    const std::vector<std::string> inputs{write("a", "1"), write("b", "1"), write("c", "fails")};
    Batch batch = shell("grep -q fails \"$0\" && exit 1; echo '{\"read\": true}'");
    const Sums first = run(inputs, batch);
    EXPECT_EQ(std::tuple(first.done, first.kept, first.failed), std::tuple(2U, 0U, 1U));
    const Sums second = run(inputs, batch);
    EXPECT_EQ(std::tuple(second.done, second.kept, second.failed), std::tuple(0U, 2U, 1U));
    write("a", "2");
    write("c", "mended");
    EXPECT_EQ(pendingOf(inputs, batch).size(), 2U);
    const Sums third = run(inputs, batch);
    EXPECT_EQ(std::tuple(third.done, third.kept, third.failed), std::tuple(2U, 1U, 0U));
    EXPECT_TRUE(pendingOf(inputs, batch).empty());
    batch.programIdentity = "2";
    EXPECT_EQ(pendingOf(inputs, batch).size(), 3U) << "another program may do it otherwise";
    batch.programIdentity = "1";
    batch.with = {write("mesh", "1")};
    EXPECT_EQ(pendingOf(inputs, batch).size(), 3U);
    EXPECT_EQ(run(inputs, batch).done, 3U);
    write("mesh", "2");
    EXPECT_EQ(pendingOf(inputs, batch).size(), 3U) << "a file that counts has changed";
}

TEST_F(Batches, keep_what_failed_where_that_is_asked_for) {
    const std::vector<std::string> inputs{write("a", "1")};
    Batch batch = shell("exit 1");
    EXPECT_EQ(run(inputs, batch).failed, 1U);
    batch.keepsFailed = true;
    EXPECT_TRUE(pendingOf(inputs, batch).empty());
    const auto heard = runBatch(inputs, batch, [](const Record&, bool kept) { EXPECT_TRUE(kept); });
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->failed, 1U) << "it is not done for that";
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
    const Sums sums = run({"slow", "greedy", "crash", "loud", "good", "fine"}, batch);
    EXPECT_EQ(std::pair(sums.done, sums.failed), std::pair(std::size_t{3}, std::size_t{3}));
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
    EXPECT_EQ(run({input}, batch).done, 1U);
    EXPECT_EQ(records().size(), 1U) << "what a writer that died left behind is none";
    write("results/records/torn.json", "{\"input\": \"a");
    const auto torn = readRecords({folder_ / "results"});
    ASSERT_FALSE(torn);
    EXPECT_EQ(torn.error().diagnostics.at(0).code, 8105);
    EXPECT_EQ(readRecords({folder_ / "nothing"}).error().diagnostics.at(0).code, 8106);
}

TEST_F(Batches, refuse_a_record_whose_numbers_do_not_fit) {
    const std::string input = write("a", "1");
    EXPECT_EQ(run({input}, shell("echo '{}'")).done, 1U);
    const Record good = readRecords({folder_ / "results"})->at(0);
    const fs::path file = recordFile(folder_ / "results", good.input, good.command);
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

TEST_F(Batches, are_one_table_whoever_ran_them) {
    Batch batch = shell("case \"$0\" in *bad) echo 'a: error TG1101: no' >&2; exit 1;; *) echo \"{\\\"mesh\\\": {\\\"faces\\\": 7}, "
                        "\\\"rows\\\": [${#0}]}\";; esac");
    const std::vector<std::string> inputs{"a", "bad", "c, \"d\"|<"};
    batch.results = folder_ / "one";
    run({inputs[0]}, batch);
    batch.results = folder_ / "two";
    run({inputs[1], inputs[2]}, batch);
    const auto all = readRecords({folder_ / "one", folder_ / "two"});
    ASSERT_TRUE(all);
    const Table table = tableOf(*all, {*columnOf("faces=/mesh/faces"), *columnOf("/rows/0")});
    EXPECT_EQ(table.header, (std::vector<std::string>{"input", "state", "seconds", "MiB", "faces", "0", "message"}));
    ASSERT_EQ(table.rows.size(), 3U);
    EXPECT_EQ(table.rows[0][0], "bad") << "what failed stands first";
    EXPECT_EQ(table.rows[0].back(), "a: error TG1101: no");
    EXPECT_EQ(table.rows[1][4], "7");
    EXPECT_NE(csvOf(table).find("\n\"c, \"\"d\"\"|<\",done,"), std::string::npos) << csvOf(table);
    EXPECT_NE(markdownOf(table).find("c, \"d\"\\|<"), std::string::npos);
    EXPECT_NE(pageOf(table, sumsOf(*all)).find("<td>c, \"d\"|&lt;</td>"), std::string::npos);
    EXPECT_EQ(sumsOf(*all).substr(0, 28), "3 inputs: 2 done, 1 failed; ");
    for (const char* wrong : {"", "faces", "=/faces", "a/b"})
        EXPECT_EQ(columnOf(wrong) ? 0 : columnOf(wrong).error().diagnostics.at(0).code, 8108) << wrong;

    Record plain = all->front();
    plain.result = "no JSON";
    EXPECT_EQ(joinedResults({plain}).error().diagnostics.at(0).code, 8109);
    const auto joined = joinedResults(*all);
    ASSERT_TRUE(joined);
    const auto json = nlohmann::json::parse(*joined);
    EXPECT_EQ(json["rows"], (nlohmann::json{1, 8})) << "arrays one behind another";
    EXPECT_EQ(json["mesh"]["faces"], 7);
}

TEST_F(Batches, of_many_at_a_time_run_each_input_once) {
    std::vector<std::string> inputs;
    for (int i = 0; i < 200; ++i)
        inputs.push_back("input " + std::to_string(i));
    Batch batch = shell("echo \"$0\" >> '" + (folder_ / "seen").string() + "'");
    batch.jobs = 16;
    EXPECT_EQ(run(inputs, batch).done, inputs.size());
    const auto seen = readFile(folder_ / "seen");
    ASSERT_TRUE(seen);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(*seen, '\n')), inputs.size());
    EXPECT_EQ(records().size(), inputs.size());
}

TEST(SlurmScripts, hold_any_word_as_one) {
    const std::string script = slurmScript("/opt/it's here/tegument", 100, {"--list", "a b.txt", "--", "prep", "{}", "$x'`"},
                                           {"--partition=short"}, "/shared/logs");
    EXPECT_NE(script.find("#SBATCH --array=1-100\n"), std::string::npos);
    EXPECT_NE(script.find("#SBATCH --partition=short\n"), std::string::npos);
    EXPECT_NE(
        script.find("exec '/opt/it'\\''s here/tegument' batch --shard \"$SLURM_ARRAY_TASK_ID/100\" '--list' 'a b.txt' '--' 'prep' '{}' "
                    "'$x'\\''`'\n"),
        std::string::npos)
        << script;
}

} // namespace
} // namespace tegument::batch
