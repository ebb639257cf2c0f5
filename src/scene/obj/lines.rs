//! A reader that counts lines.

use std::io::{BufRead, Read, Result as IoResult};

/// Reads a text and knows the line it is at, which `tobj`'s errors lack.
pub struct CountLines<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> CountLines<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { rest: text.as_bytes(), line: 0 }
    }

    /// The line of the file last read; the extra first line of the plain text is line 0.
    pub fn line(&self) -> usize {
        self.line.saturating_sub(1)
    }
}

impl Read for CountLines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> IoResult<usize> {
        let read = self.rest.read(buffer)?;
        self.line += buffer[..read].iter().filter(|&&byte| byte == b'\n').count();
        Ok(read)
    }
}

impl BufRead for CountLines<'_> {
    fn fill_buf(&mut self) -> IoResult<&[u8]> {
        Ok(self.rest)
    }

    fn consume(&mut self, amount: usize) {
        let (read, rest) = self.rest.split_at(amount.min(self.rest.len()));
        self.line += read.iter().filter(|&&byte| byte == b'\n').count();
        self.rest = rest;
    }
}
