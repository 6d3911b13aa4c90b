//! Exports spans to a collector: OTLP over HTTP, in batches, from its own thread.

use core::fmt;
use core::str::FromStr;
use core::time::Duration;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use opentelemetry::trace::TracerProvider;
use opentelemetry_otlp::{WithExportConfig, WithHttpConfig};
use opentelemetry_sdk::Resource;
use opentelemetry_sdk::error::OTelSdkResult;
use opentelemetry_sdk::trace::{BatchConfigBuilder, BatchSpanProcessor, SdkTracerProvider, SpanData, SpanExporter};
use reqwest::Url;
use reqwest::blocking::ClientBuilder;
use rustls::RootCertStore;

use crate::jobs::client_builder;
use crate::traces;

/// Spans in the export queue; more are dropped. About 2 MB.
const QUEUE: usize = 2048;
/// Spans per export.
const BATCH: usize = 512;
/// The longest delay of a span for its batch.
const DELAY: Duration = Duration::from_secs(2);
/// Timeout of an export, with retries.
const EXPORT_PATIENCE: Duration = Duration::from_secs(10);
/// How long the process waits at its end for the last spans. Short against any shutdown limit.
const FLUSH: Duration = Duration::from_secs(2);
/// The least time between two log lines about a failing collector.
const COMPLAINT_PAUSE: Duration = Duration::from_secs(60);

/// The address of a collector: its URL before `/v1/traces`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Endpoint(Url);

impl FromStr for Endpoint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // The client has no TLS; a collector runs close by.
        let url = Url::parse(text).ok().filter(|url| url.scheme() == "http" && url.has_host());
        let plain = url.filter(|url| url.query().is_none() && url.fragment().is_none());
        plain.map(Self).ok_or_else(|| format!("'{text}' is not a URL like http://localhost:4318"))
    }
}

impl fmt::Display for Endpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.as_str().trim_end_matches('/'))
    }
}

/// The running export of spans.
#[derive(Debug)]
pub struct Export {
    provider: SdkTracerProvider,
}

impl Export {
    /// Start to collect and export. Not within an async context, since the client blocks.
    ///
    /// # Errors
    /// If the exporter can't be made.
    pub fn begin(endpoint: &Endpoint) -> Result<Self, String> {
        let export = Self::to(endpoint, EXPORT_PATIENCE)?;
        traces::collect(export.provider.tracer(env!("CARGO_PKG_NAME")));
        Ok(export)
    }

    fn to(endpoint: &Endpoint, patience: Duration) -> Result<Self, String> {
        // A proxy from the environment would be asked for a machine close by.
        let client = ClientBuilder::from(client_builder(RootCertStore::empty())).timeout(patience).no_proxy().build();
        let exporter = opentelemetry_otlp::SpanExporter::builder()
            .with_http()
            .with_http_client(client.map_err(|error| error.to_string())?)
            .with_endpoint(format!("{endpoint}/v1/traces"))
            .with_timeout(patience)
            .build()
            .map_err(|error| error.to_string())?;
        let config = BatchConfigBuilder::default()
            .with_max_queue_size(QUEUE)
            .with_max_export_batch_size(BATCH)
            .with_scheduled_delay(DELAY);
        let exporter = Telling { exporter, complained: Mutex::default() };
        let processor = BatchSpanProcessor::builder(exporter).with_batch_config(config.build()).build();
        let resource = Resource::builder().with_service_name(env!("CARGO_PKG_NAME"));
        let resource =
            resource.with_attribute(opentelemetry::KeyValue::new("service.version", env!("CARGO_PKG_VERSION")));
        let provider = SdkTracerProvider::builder().with_span_processor(processor).with_resource(resource.build());
        Ok(Self { provider: provider.build() })
    }

    /// Export the collected spans, and wait at most two seconds for the collector. Blocks.
    pub fn finish(self) {
        if let Err(error) = self.provider.shutdown_with_timeout(FLUSH) {
            tracing::warn!(%error, "the last spans were not delivered");
        }
    }
}

/// An exporter that logs failures, at a limited rate.
#[derive(Debug)]
struct Telling<E> {
    exporter: E,
    complained: Mutex<Option<Instant>>,
}

impl<E> Telling<E> {
    fn complain(&self, error: &dyn fmt::Display) {
        let mut complained = self.complained.lock().unwrap_or_else(PoisonError::into_inner);
        if complained.is_none_or(|last| last.elapsed() >= COMPLAINT_PAUSE) {
            *complained = Some(Instant::now());
            tracing::warn!(%error, "spans were not delivered; further failures are logged at most once a minute");
        }
    }
}

impl<E: SpanExporter> SpanExporter for Telling<E> {
    async fn export(&self, batch: Vec<SpanData>) -> OTelSdkResult {
        let exported = self.exporter.export(batch).await;
        if let Err(error) = &exported {
            self.complain(error);
        }
        exported
    }

    fn shutdown_with_timeout(&self, timeout: Duration) -> OTelSdkResult {
        self.exporter.shutdown_with_timeout(timeout)
    }

    fn shutdown(&self) -> OTelSdkResult {
        self.exporter.shutdown()
    }

    fn force_flush(&self) -> OTelSdkResult {
        self.exporter.force_flush()
    }

    fn set_resource(&mut self, resource: &Resource) {
        self.exporter.set_resource(resource);
    }
}

#[cfg(test)]
mod tests {
    use std::io::{ErrorKind, Read};
    use std::net::TcpListener;

    use opentelemetry::trace::{Span, Tracer};
    use opentelemetry_sdk::error::OTelSdkError;

    use super::*;

    /// Long enough for any machine.
    const PATIENCE: Duration = Duration::from_secs(60);

    #[test]
    fn an_endpoint_is_a_plain_url() {
        let shown = |text: &str| text.parse::<Endpoint>().map(|endpoint| endpoint.to_string()).ok();
        assert_eq!(shown("http://localhost:4318"), Some("http://localhost:4318".to_owned()));
        assert_eq!(shown("http://10.0.0.7/otlp/"), Some("http://10.0.0.7/otlp".to_owned()));
        for text in ["https://localhost:4318", "localhost:4318", "http://", "http://a/?b", "grpc://a:4317"] {
            assert_eq!(shown(text), None, "{text}");
        }
    }

    #[test]
    fn a_collector_that_never_answers_is_not_waited_for() {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let endpoint = format!("http://{}", listener.local_addr().unwrap()).parse().unwrap();
        // Only the bound on the flush can end it while the exporter still waits.
        let export = Export::to(&endpoint, PATIENCE).unwrap();
        export.provider.tracer("test").start("span").end();
        export.finish();
        let (mut stream, _) = listener.accept().unwrap();
        stream.set_read_timeout(Some(Duration::from_millis(100))).unwrap();
        let mut request = Vec::new();
        let error = stream.read_to_end(&mut request).expect_err("the exporter still waits for its answer");
        assert_eq!(error.kind(), ErrorKind::WouldBlock);
        assert!(request.starts_with(b"POST /v1/traces HTTP/1.1\r\n"));
    }

    #[derive(Debug)]
    struct Failing;

    impl SpanExporter for Failing {
        async fn export(&self, _: Vec<SpanData>) -> OTelSdkResult {
            Err(OTelSdkError::InternalFailure("on purpose".to_owned()))
        }
    }

    #[tokio::test]
    async fn a_failing_collector_is_logged_once_a_minute() {
        let exporter = Telling { exporter: Failing, complained: Mutex::default() };
        let complained = || *exporter.complained.lock().unwrap();
        assert!(exporter.export(Vec::new()).await.is_err());
        let first = complained();
        assert!(first.is_some() && exporter.export(Vec::new()).await.is_err());
        assert_eq!(complained(), first);
    }
}
