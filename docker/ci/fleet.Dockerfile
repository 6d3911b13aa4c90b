# What docker/compose.fleet.yaml takes from public images, from Debian's packages: the same users, files, variables and
# arguments, as far as the fleet uses them.
FROM singulate-check/debian AS postgres
COPY postgres-start /usr/local/bin/postgres-start
VOLUME /var/lib/postgresql/data
STOPSIGNAL SIGINT
ENTRYPOINT ["/usr/local/bin/postgres-start"]

FROM singulate-check/debian AS haproxy
USER haproxy
STOPSIGNAL SIGUSR1
CMD ["haproxy", "-W", "-db", "-f", "/usr/local/etc/haproxy/haproxy.cfg"]

FROM singulate-check/debian AS prometheus
RUN mkdir /prometheus && chown nobody:nogroup /prometheus
USER nobody
VOLUME /prometheus
WORKDIR /prometheus
ENTRYPOINT ["/usr/bin/prometheus"]
CMD ["--config.file=/etc/prometheus/prometheus.yml", "--storage.tsdb.path=/prometheus"]
