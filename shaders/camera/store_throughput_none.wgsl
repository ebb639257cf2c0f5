// No mirrors or glass: every throughput is 1, and there is nothing to store.

fn store_throughput(index: u32, chain: SpecularChain) {}
