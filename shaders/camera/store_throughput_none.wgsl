// What is seen is seen as it is.

fn keep_throughput(index: u32, sight: Sight) {}
